#include "grid/screen_broad_phase.h"

#include <algorithm>
#include <cmath>

#include "geom/projection/row_slopes.h"

namespace clusterbench::grid {
namespace {

using Hull = geom::SlopeHull<double>;
using Eye = geom::BallFromEye<double>;
using DepthRange = geom::DepthRange<double>;

IndexRange columns_touched(const Tiles& tiles, const Hull& slopes) {
  return intervals_touched(tiles.x, slopes.lo, slopes.hi);
}

// Appends the rows of one slab of depths.
void append_slab(const Tiles& tiles, const BallInSpace& ball, DepthRange range, int slice, bool with_inner,
                 std::vector<CellRow>& rows) {
  const Eye larger{ball.center.x, ball.center.y, -ball.center.z, ball.radius + ball.slack};
  const Eye smaller{larger.x, larger.y, larger.depth, std::max(0.0, ball.radius - ball.slack)};
  Hull up;
  geom::add_disk(up, larger.y, larger.depth, larger.radius * larger.radius, range.near, range.far, 1.0,
                 geom::Errs::outward);
  const IndexRange touched = descending_intervals_touched(tiles.y, up.lo, up.hi);
  for (int row = touched.first; row <= touched.last; ++row) {
    const double y0 = tiles.y_min(row), y1 = tiles.y_max(row);
    CellRow found;
    found.outer = columns_touched(tiles, geom::row_slopes(larger, y0, y1, range, geom::Errs::outward));
    if (found.outer.empty()) continue;
    if (with_inner && ball.radius > ball.slack)
      found.inner = columns_touched(tiles, geom::row_slopes(smaller, y0, y1, range, geom::Errs::inward));
    found.first_cell = cell_index({0, row, slice}, {tiles.count.x, tiles.count.y, 0});
    rows.push_back(found);
  }
}

// Perspective frustum grids: rows of cells by the extremes of slope over row ∩ ball.
class FrustumBroadPhase final : public BroadPhase {
 public:
  explicit FrustumBroadPhase(const ScreenGrid& grid) : grid_(grid) {}

  void append_rows(const BallInSpace& ball, std::vector<CellRow>& rows) const override {
    const std::vector<float>& depths = grid_.slices.boundaries;
    const double depth = -ball.center.z, reach = ball.radius + ball.slack;
    const IndexRange slices = intervals_touched(depths, depth - reach, depth + reach);
    for (int slice = slices.first; slice <= slices.last; ++slice) {
      const auto k = static_cast<std::size_t>(slice);
      append_slab(grid_.tiles, ball, {depths[k], depths[k + 1]}, slice, true, rows);
    }
  }

 private:
  const ScreenGrid& grid_;
};

// Distance grids: rows of tiles, each through the shells that the ball may touch.
class ShellBroadPhase final : public BroadPhase {
 public:
  explicit ShellBroadPhase(const ScreenGrid& grid) : grid_(grid) {}

  void append_rows(const BallInSpace& ball, std::vector<CellRow>& rows) const override {
    const IndexRange shells = shells_near(ball);
    if (shells.empty()) return;
    const std::size_t before = rows.size();
    append_tile_rows(grid_.tiles, ball, rows);
    for (std::size_t row = before; row < rows.size(); ++row) rows[row].slices = shells;
  }

 private:
  IndexRange shells_near(const BallInSpace& ball) const {
    constexpr double k_slack = 1e-12;  // much more than the rounding of a distance
    const double distance = glm::length(ball.center), reach = ball.radius + ball.slack;
    const double wider = reach + k_slack * (distance + reach);
    return intervals_touched(grid_.slices.boundaries, distance - wider, distance + wider);
  }

  const ScreenGrid& grid_;
};

BoxBlock orthographic_block(const ScreenGrid& grid) {
  BoxBlock block{extents_between(grid.tiles.x), extents_between(grid.tiles.y), {}, 0};
  for (const Extent& depth : extents_between(grid.slices.boundaries)) block.z.push_back({-depth.hi, -depth.lo});
  return block;
}

}  // namespace

void append_tile_rows(const Tiles& tiles, const BallInSpace& ball, std::vector<CellRow>& rows) {
  const double reach = std::max(0.0, -ball.center.z + ball.radius + ball.slack);
  append_slab(tiles, ball, {0.0, reach}, 0, false, rows);
}

std::unique_ptr<BroadPhase> ScreenGrid::broad_phase() const {
  if (by_distance) return std::make_unique<ShellBroadPhase>(*this);
  if (tiles.orthographic) return std::make_unique<BoxBroadPhase>(std::vector{orthographic_block(*this)});
  return std::make_unique<FrustumBroadPhase>(*this);
}

}  // namespace clusterbench::grid
