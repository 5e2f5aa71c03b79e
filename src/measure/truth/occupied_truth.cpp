// The occupied cells of a frustum grid, with depth ranges, as truth cells.

#include "geom/single_precision/bounding_volumes.h"
#include "grid/screen_broad_phase.h"
#include "measure/truth/truth_cells.h"

namespace clusterbench::measure {
namespace {

using geom::Verdict;

// Tile by tile: all cells of a tile are within the depths of the frame in that tile.
class OccupiedTruthCells final : public TruthCells {
 public:
  OccupiedTruthCells(const view::Frame& frame, const grid::Grid& grid, const grid::OccupiedCells& cells)
      : space_(frame.view_space), tiles_(grid.screen().tiles), cells_(cells) {
    if (frame.ranges().spots.empty() && frame.ranges().boxes.empty()) return;
    for (const geom::FrustumCell& part : cells.parts) balls_.push_back(geom::ball_around(part));
  }

  std::uint32_t cell_count() const override { return cells_.cell_count(); }
  const view::Space& space() const override { return space_; }
  grid::CellRow all() const override { return {0, {0, static_cast<int>(tile_count()) - 1}, {}, all_slices()}; }
  void append_candidates(const grid::BallInSpace& ball, std::vector<grid::CellRow>& rows) const override {
    if (tiles_.orthographic) return rows.push_back(all());
    grid::append_tile_rows(tiles_, ball, rows);
    for (grid::CellRow& row : rows) row.slices = all_slices();
  }
  void decide(std::uint32_t tile, const grid::IndexRange& slices, LightSearch& search) const override {
    for (int slice = slices.first; slice <= slices.last; ++slice) {
      const std::uint32_t cell = static_cast<std::uint32_t>(slice) * tile_count() + tile;
      search.decide(cell, [&] {
        return meets_any(cells_.of(cell), [&](const geom::FrustumCell& part) { return meets_part(part, search); });
      });
    }
  }

 private:
  std::uint32_t tile_count() const { return static_cast<std::uint32_t>(tiles_.count.x * tiles_.count.y); }
  geom::Ball ball_around(const geom::FrustumCell& part) const {
    return balls_.empty() ? geom::Ball{} : balls_[static_cast<std::size_t>(&part - cells_.parts.data())];
  }
  grid::IndexRange all_slices() const { return {0, cells_.counts.z - 1}; }

  Verdict meets_part(const geom::FrustumCell& part, const LightSearch& search) const {
    const grid::BallInSpace& ball = search.ball();
    const double depth = -ball.center.z, reach = ball.radius + ball.slack;
    if (depth + reach < part.depth0 || depth - reach > part.depth1) return Verdict::no;
    const Verdict verdict = search.filtered(part, ball_around(part));
    return verdict == Verdict::uncertain ? search.decided(part) : verdict;
  }

  view::Space space_;
  const grid::Tiles& tiles_;
  const grid::OccupiedCells& cells_;
  std::vector<geom::Ball> balls_;  // around the parts; only with spots or boxes
};

}  // namespace

std::unique_ptr<TruthCells> truth_cells(const view::Frame& frame, const grid::Grid& grid,
                                        const grid::OccupiedCells& occupied) {
  return std::make_unique<OccupiedTruthCells>(frame, grid, occupied);
}

}  // namespace clusterbench::measure
