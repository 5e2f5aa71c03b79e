// The cells of grids as truth cells.

#include <limits>
#include <optional>

#include "geom/filter/light_filter.h"
#include "measure/truth/truth_cells.h"

namespace clusterbench::measure {
namespace {

using geom::Verdict;

// Cells of any kind: each is decided alone.
class GridCells : public TruthCells {
 public:
  GridCells(const view::Frame& frame, const grid::Grid& grid)
      : grid_(grid), space_(grid::space_of(grid, frame)), broad_phase_(grid.broad_phase()) {
    if (!frame.ranges().spots.empty() || !frame.ranges().boxes.empty()) balls_ = grid.balls_around_cells();
  }

  std::uint32_t cell_count() const final { return grid_.cell_count(); }
  const view::Space& space() const final { return space_; }
  void append_candidates(const grid::BallInSpace& ball, std::vector<grid::CellRow>& rows) const final {
    broad_phase_->append_rows(ball, rows);
  }
  void decide(std::uint32_t cell, const grid::IndexRange&, LightSearch& search) const override {
    if (grid_.is_hole(cell)) return;
    const geom::Cell shape = grid_.cell(cell);
    search.decide(cell, [&] {
      const Verdict verdict = search.filtered(shape, ball_around(cell));
      return verdict == Verdict::uncertain ? search.decided(shape) : verdict;
    });
  }

 protected:
  geom::Ball ball_around(std::uint32_t cell) const { return balls_.empty() ? geom::Ball{} : balls_[cell]; }

  const grid::Grid& grid_;

 private:
  view::Space space_;
  std::unique_ptr<grid::BroadPhase> broad_phase_;
  std::vector<geom::Ball> balls_;  // around the cells; only with spots or boxes
};

// The filter's knowledge of a spot in one tile of a distance grid. A proof for one shell holds for all shells beyond
// it, or before it.
class SpotTile {
 public:
  SpotTile(const geom::LightFilter& filter, const geom::ShellCell& tile)
      : filter_(filter), tile_(tile), reach_(filter.distances(tile)) {}

  Verdict meets(const geom::ShellCell& shell) {
    const double near = shell.distance0, far = shell.distance1;
    if (!reach_.may_reach(near, far) || near >= ends_before_ || far <= begins_after_) return Verdict::no;
    if (reach_.surely_reaches(near, far)) return Verdict::yes;
    if (near > reach_.likely_hi && is_apart(shell.distance0, tile_.distance1)) {
      ends_before_ = near;
      return Verdict::no;
    }
    if (far < reach_.likely_lo && is_apart(0.0f, shell.distance1)) {
      begins_after_ = far;
      return Verdict::no;
    }
    return Verdict::uncertain;
  }

 private:
  bool is_apart(float near, float far) const {
    return filter_.is_surely_apart({tile_.x0, tile_.x1, tile_.y0, tile_.y1, near, far});
  }

  const geom::LightFilter& filter_;
  geom::ShellCell tile_;
  geom::DistanceInterval reach_;
  double ends_before_ = std::numeric_limits<double>::infinity(), begins_after_ = -1.0;
};

// Cells of a distance grid: the shells of a tile are decided together, since they share most of the work.
class ShellCells final : public GridCells {
 public:
  using GridCells::GridCells;

  void decide(std::uint32_t tile, const grid::IndexRange& shells, LightSearch& search) const override {
    if (search.is_endless())
      GridCells::decide(tile, shells, search);
    else if (search.is_spot())
      decide_spot(tile, shells, search);
    else if (search.is_box())
      decide_box(tile, shells, search);
    else
      decide_ball(tile, shells, search);
  }

 private:
  std::uint32_t cell_at(std::uint32_t tile, int shell) const {
    const Vec2i count = grid_.screen().tiles.count;
    return static_cast<std::uint32_t>(shell) * static_cast<std::uint32_t>(count.x * count.y) + tile;
  }
  geom::ShellCell shape_of(std::uint32_t cell) const { return std::get<geom::ShellCell>(grid_.cell(cell)); }

  void decide_ball(std::uint32_t tile, const grid::IndexRange& shells, LightSearch& search) const {
    const geom::BallDecider& decider = search.ball_decider();
    const geom::PyramidView view = decider.view_of(shape_of(tile));
    for (int shell = shells.first; shell <= shells.last; ++shell) {
      const std::uint32_t cell = cell_at(tile, shell);
      search.decide(cell, [&] { return decider.meets(shape_of(cell), view) ? Verdict::yes : Verdict::no; });
    }
  }

  // A spot's distances are expensive: computed only if a shell needs them.
  void decide_spot(std::uint32_t tile, const grid::IndexRange& shells, LightSearch& search) const {
    std::optional<SpotTile> reached;
    for (int shell = shells.first; shell <= shells.last; ++shell) {
      const std::uint32_t cell = cell_at(tile, shell);
      const geom::ShellCell shape = shape_of(cell);
      search.decide(cell, [&] {
        Verdict verdict = search.filtered(shape, ball_around(cell));
        if (verdict != Verdict::uncertain) return verdict;
        if (!reached) reached.emplace(search.spot_decider().filter(), up_to(tile, shells.last));
        verdict = reached->meets(shape);
        return verdict == Verdict::uncertain ? search.decided(shape) : verdict;
      });
    }
  }

  void decide_box(std::uint32_t tile, const grid::IndexRange& shells, LightSearch& search) const {
    const geom::BoxDecider& decider = search.box_decider();
    std::optional<geom::BoxView> view;
    for (int shell = shells.first; shell <= shells.last; ++shell) {
      const std::uint32_t cell = cell_at(tile, shell);
      const geom::ShellCell shape = shape_of(cell);
      search.decide(cell, [&] {
        const Verdict verdict = search.filtered(shape, ball_around(cell));
        if (verdict != Verdict::uncertain) return verdict;
        if (!view) view = decider.view_of(shape);
        return decider.meets(shape, *view) ? Verdict::yes : Verdict::no;
      });
    }
  }

  geom::ShellCell up_to(std::uint32_t tile, int last_shell) const {
    geom::ShellCell shape = shape_of(tile);
    shape.distance1 = grid_.screen().slices.boundaries[static_cast<std::size_t>(last_shell) + 1];
    return shape;
  }
};

}  // namespace

std::unique_ptr<TruthCells> truth_cells(const view::Frame& frame, const grid::Grid& grid) {
  if (grid.kind() == grid::Kind::distance) return std::make_unique<ShellCells>(frame, grid);
  return std::make_unique<GridCells>(frame, grid);
}

}  // namespace clusterbench::measure
