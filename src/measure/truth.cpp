#include "measure/truth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "geom/ball/ball_decider.h"
#include "geom/filter/light_filter.h"
#include "geom/shapes/verdict.h"
#include "geom/spot/spot_decider.h"
#include "measure/truth_cells.h"
#include "measure/truth_rows.h"

namespace clusterbench::measure {
namespace {

using geom::Verdict;

// Is a point well inside a cell?
struct WellInside {
  Vec3d p;

  static bool between(double lo, double value, double hi) {
    const double rounding = 0x1p-40 * (std::abs(lo) + std::abs(hi));
    return value > lo + rounding && value < hi - rounding;
  }
  bool operator()(const geom::FrustumCell& c) const {
    const double depth = -p.z, scale = c.orthographic ? 1.0 : depth;
    return between(c.depth0, depth, c.depth1) && between(c.x0 * scale, p.x, c.x1 * scale) &&
           between(c.y0 * scale, p.y, c.y1 * scale);
  }
  bool operator()(const geom::ShellCell& c) const {
    const double depth = -p.z;
    return depth > 0.0 && between(c.distance0, glm::length(p), c.distance1) &&
           between(c.x0 * depth, p.x, c.x1 * depth) && between(c.y0 * depth, p.y, c.y1 * depth);
  }
  bool operator()(const geom::Box& c) const {
    return between(c.lo.x, p.x, c.hi.x) && between(c.lo.y, p.y, c.hi.y) && between(c.lo.z, p.z, c.hi.z);
  }
};

// What a spot reaches of one tile of a distance grid, as a filter knows it. What is proven of a shell is true of all
// shells beyond it, or before it.
class SpotTile {
 public:
  SpotTile(const geom::LightFilter& filter, const geom::ShellCell& tile)
      : filter_(filter), tile_(tile), reach_(filter.distances(tile)) {}

  // Boundaries of the grid: near, far are numbers of single precision.
  Verdict meets(double near, double far) {
    if (!reach_.may_reach(near, far) || near >= ends_before_ || far <= begins_after_) return Verdict::no;
    if (reach_.surely_reaches(near, far)) return Verdict::yes;
    if (near > reach_.likely_hi && is_apart(near, tile_.distance1)) {
      ends_before_ = near;
      return Verdict::no;
    }
    if (far < reach_.likely_lo && is_apart(0.0, far)) {
      begins_after_ = far;
      return Verdict::no;
    }
    return Verdict::uncertain;
  }

 private:
  bool is_apart(double near, double far) const {
    return filter_.is_surely_apart(
        {tile_.x0, tile_.x1, tile_.y0, tile_.y1, static_cast<float>(near), static_cast<float>(far)});
  }

  const geom::LightFilter& filter_;
  geom::ShellCell tile_;
  geom::DistanceInterval reach_;
  double ends_before_ = std::numeric_limits<double>::infinity(), begins_after_ = -1.0;
};

// Finds true cells light by light. Made once per frame; const, so that threads can share it.
class TruthFinder {
 public:
  TruthFinder(const view::Frame& frame, const grid::Grid& grid)
      : frame_(frame), grid_(grid), space_(grid::space_of(grid, frame)) {
    if (!is_tilted()) blocks_ = box_blocks(grid);
    if (!frame.ranges().spots.empty()) cell_balls_ = grid_.balls_around_cells();
  }

  LightCells find(std::uint32_t light) const {
    Search search(view::volume_of(frame_.lights[light], space_));
    const geom::LightVolume& volume = search.volume;
    if (volume.range == 0.0) return {};
    if (std::isinf(volume.range)) {
      for (std::uint32_t cell = 0; cell < grid_.cell_count(); ++cell) settle_endless(cell, search);
      return std::move(search.found);
    }
    std::vector<Row> rows;
    if (has_shells()) {
      search.shells = shells_near(search.ball);
      if (search.shells.empty()) return {};
      append_tile_rows(grid_.screen(), search.ball, rows);
      for (const Row& row : rows) settle_tiles(row, search);
      return std::move(search.found);
    }
    if (is_tilted()) append_rows(grid_.screen(), search.ball, rows);
    for (const BoxBlock& block : blocks_) append_rows(block, search.ball, rows);
    for (const Row& row : rows) volume.is_cone ? settle_spot_row(row, search) : settle_row(row, search);
    return std::move(search.found);
  }

 private:
  // One light in the making.
  struct Search {
    geom::LightVolume volume;
    geom::BallDecider decider;  // of points
    std::optional<geom::SpotDecider> spot;
    BallInSpace ball;
    QuickCone cone;
    grid::IndexRange shells;  // of a distance grid
    LightCells found;

    explicit Search(const geom::LightVolume& light)
        : volume(light),
          decider(light.apex, std::isinf(light.range) ? 0.0 : light.range),  // endless ones ask nothing
          spot(light.is_cone ? std::optional<geom::SpotDecider>(light) : std::nullopt),
          ball(ball_in_space(light)),
          cone(light, ball) {}
  };

  bool has_shells() const { return grid_.has_tiles() && grid_.screen().by_distance; }
  // Cells with sides through the eye.
  bool is_tilted() const { return grid_.has_tiles() && !grid_.screen().tiles.orthographic; }

  void settle_row(const Row& row, Search& search) const {
    const auto decide_columns = [&](int first, int last) {
      for (int column = first; column <= last; ++column)
        decide_ball(row.first_cell + static_cast<std::uint32_t>(column), search);
    };
    if (row.inner.empty()) return decide_columns(row.outer.first, row.outer.last);
    decide_columns(row.outer.first, row.inner.first - 1);
    const auto count = static_cast<std::uint32_t>(row.inner.last - row.inner.first + 1);
    search.found.filter_decided += count;
    search.found.add(row.first_cell + static_cast<std::uint32_t>(row.inner.first), count);
    decide_columns(row.inner.last + 1, row.outer.last);
  }

  void settle_spot_row(const Row& row, Search& search) const {
    for (int column = row.outer.first; column <= row.outer.last; ++column) {
      const std::uint32_t cell = row.first_cell + static_cast<std::uint32_t>(column);
      if (!is_quick(cell, search)) decide(cell, search);
    }
  }

  // One row of tiles of a distance grid, through all shells.
  void settle_tiles(const Row& row, Search& search) const {
    for (int column = row.outer.first; column <= row.outer.last; ++column) {
      const std::uint32_t tile = row.first_cell + static_cast<std::uint32_t>(column);
      search.volume.is_cone ? settle_spot_tile(tile, search) : settle_tile(tile, search);
    }
  }

  // Shells that a ball may touch.
  grid::IndexRange shells_near(const BallInSpace& ball) const {
    constexpr double k_slack = 1e-12;  // far more than the rounding of a distance
    const double distance = glm::length(ball.center), reach = ball.radius + ball.slack;
    const double wider = reach + k_slack * (distance + reach);
    return grid::intervals_touched(grid_.screen().slices.boundaries, distance - wider, distance + wider);
  }

  // Calls take(cell, near, far) for the shells of a tile that the light's ball may touch.
  template <class Take>
  void each_shell(std::uint32_t tile, const Search& search, Take&& take) const {
    const grid::ScreenGrid& grid = grid_.screen();
    const auto tiles = static_cast<std::uint32_t>(grid.tiles.count.x * grid.tiles.count.y);
    for (int shell = search.shells.first; shell <= search.shells.last; ++shell) {
      const auto k = static_cast<std::size_t>(shell);
      take(static_cast<std::uint32_t>(shell) * tiles + tile, grid.slices.boundaries[k], grid.slices.boundaries[k + 1]);
    }
  }

  void settle_tile(std::uint32_t tile, Search& search) const {
    const geom::PyramidView view = search.decider.view_of(std::get<geom::ShellCell>(grid_.cell(tile)));
    each_shell(tile, search, [&](std::uint32_t cell, double, double) {
      count_ball(cell, search, [&] { return search.decider.meets(std::get<geom::ShellCell>(grid_.cell(cell)), view); });
    });
  }

  void decide_ball(std::uint32_t cell, Search& search) const {
    count_ball(cell, search, [&] { return search.decider.meets(grid_.cell(cell)); });
  }

  template <class Meets>
  static void count_ball(std::uint32_t cell, Search& search, Meets&& meets) {
    const std::uint64_t before = search.decider.exact_decisions();
    if (meets()) search.found.add(cell);
    ++(search.decider.exact_decisions() == before ? search.found.filter_decided : search.found.exact_decided);
  }

  // A spot's distances are costly: found only where a shell needs them.
  void settle_spot_tile(std::uint32_t tile, Search& search) const {
    std::optional<SpotTile> found;
    each_shell(tile, search, [&](std::uint32_t cell, double near, double far) {
      if (is_quick(cell, search)) return;
      if (!found) found.emplace(search.spot->filter(), tile_up_to_last_shell(tile, search));
      switch (found->meets(near, far)) {
        case Verdict::no:
          ++search.found.filter_decided;
          break;
        case Verdict::yes:
          take(cell, search);
          break;
        case Verdict::uncertain:
          decide(cell, search);
      }
    });
  }

  geom::ShellCell tile_up_to_last_shell(std::uint32_t tile, const Search& search) const {
    geom::ShellCell cut = std::get<geom::ShellCell>(grid_.cell(tile));
    cut.distance1 = grid_.screen().slices.boundaries[static_cast<std::size_t>(search.shells.last) + 1];
    return cut;
  }

  void settle_endless(std::uint32_t cell, Search& search) const {
    if (grid_.is_hole(cell)) return;
    search.volume.is_cone ? decide(cell, search) : take(cell, search);
  }

  // Settles a spot's cell that lies far outside of the cone's side, or whose middle lies well inside the volume.
  bool is_quick(std::uint32_t cell, Search& search) const {
    const geom::Ball& around = cell_balls_[cell];
    if (search.cone.surely_misses(around)) {
      ++search.found.filter_decided;
      return true;
    }
    const Vec3d middle(around.center);
    if (!search.cone.surely_holds(middle) || !std::visit(WellInside{middle}, grid_.cell(cell))) return false;
    take(cell, search);
    return true;
  }

  void decide(std::uint32_t cell, Search& search) const {
    const std::uint64_t before = search.spot->exact_decisions();
    count_spot(cell, search.spot->meets(grid_.cell(cell)), before, search);
  }

  static void count_spot(std::uint32_t cell, Verdict verdict, std::uint64_t exact_before, Search& search) {
    const bool is_exact = search.spot->exact_decisions() != exact_before;
    ++(verdict == Verdict::uncertain ? search.found.undecided
       : is_exact                    ? search.found.exact_decided
                                     : search.found.filter_decided);
    if (verdict != Verdict::no) search.found.add(cell);
  }

  static void take(std::uint32_t cell, Search& search) {
    ++search.found.filter_decided;
    search.found.add(cell);
  }

  const view::Frame& frame_;
  const grid::Grid& grid_;
  view::Space space_;
  std::vector<BoxBlock> blocks_;
  std::vector<geom::Ball> cell_balls_;
};

}  // namespace

Truth find_truth(const view::Frame& frame, const grid::Grid& grid, int threads) {
  const TruthFinder finder(frame, grid);
  return gathered_truth(frame.lights.size(), grid.cell_count(), threads,
                        [&](std::uint32_t light) { return finder.find(light); });
}

double relative_distance(const view::Frame& frame, const grid::Grid& grid, std::uint32_t cell, std::uint32_t light) {
  return relative_distance(view::volume_of(frame.lights[light], grid::space_of(grid, frame)), grid.cell(cell));
}

double relative_distance(const geom::LightVolume& light, const geom::Cell& cell) {
  geom::LightVolume volume = light;
  if (std::isinf(volume.range)) return 0.0;
  const double range = volume.range;
  double misses = 0.0, meets = 1.0;
  constexpr int k_halvings = 40;
  for (int i = 0; i < k_halvings; ++i) {
    const double middle = 0.5 * (misses + meets);
    volume.range = range * middle;
    (geom::filter_meets(volume, cell) == Verdict::no ? misses : meets) = middle;
  }
  return meets;
}

}  // namespace clusterbench::measure
