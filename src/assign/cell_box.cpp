#include "assign/cell_box.h"

#include <algorithm>
#include <functional>

#include "geom/tangents.h"

namespace clusterbench::assign {
namespace {

struct Range {
  int first, last;
};

// Intervals between ascending boundaries that [lo, hi] touches.
Range ascending(const std::vector<float>& boundaries, float lo, float hi) {
  const auto from = std::lower_bound(boundaries.begin() + 1, boundaries.end(), lo);
  const auto to = std::upper_bound(boundaries.begin(), boundaries.end() - 1, hi);
  return {static_cast<int>(from - boundaries.begin()) - 1, static_cast<int>(to - boundaries.begin()) - 1};
}

// The same between descending boundaries.
Range descending(const std::vector<float>& boundaries, float lo, float hi) {
  const auto from = std::lower_bound(boundaries.begin() + 1, boundaries.end(), hi, std::greater<>());
  const auto to = std::upper_bound(boundaries.begin(), boundaries.end() - 1, lo, std::greater<>());
  return {static_cast<int>(from - boundaries.begin()) - 1, static_cast<int>(to - boundaries.begin()) - 1};
}

}  // namespace

CellBox cell_box(const grid::Grid& grid, const geom::Ball& ball) {
  const grid::Tiles& tiles = grid.screen().tiles;
  const std::vector<float>& depths = grid.screen().slices.boundaries;
  const float depth = -ball.center.z;
  const auto extent = tiles.orthographic ? geom::offset_range : geom::slope_range;
  const geom::SlopeRange x = extent(ball.center.x, depth, ball.radius, depths.front(), depths.back());
  const geom::SlopeRange y = extent(ball.center.y, depth, ball.radius, depths.front(), depths.back());
  if (x.empty() || y.empty()) return {};
  const Range columns = ascending(tiles.x, x.lo, x.hi);
  const Range rows = descending(tiles.y, y.lo, y.hi);
  const Range slices = ascending(depths, depth - ball.radius, depth + ball.radius);
  return {{columns.first, rows.first, slices.first}, {columns.last, rows.last, slices.last}};
}

}  // namespace clusterbench::assign
