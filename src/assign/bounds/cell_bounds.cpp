#include "assign/bounds/cell_bounds.h"

#include "geom/projection/disk_tangents.h"
#include "grid/index_range.h"

namespace clusterbench::assign {
CellBox cell_box(const grid::Grid& grid, const geom::Ball& ball) {
  const grid::Tiles& tiles = grid.screen().tiles;
  const std::vector<float>& depths = grid.screen().slices.boundaries;
  const float depth = -ball.center.z;
  const auto extent = tiles.orthographic ? geom::offset_range : geom::slope_range;
  const geom::SlopeRange x = extent(ball.center.x, depth, ball.radius, depths.front(), depths.back());
  const geom::SlopeRange y = extent(ball.center.y, depth, ball.radius, depths.front(), depths.back());
  if (x.empty() || y.empty()) return {};
  const grid::IndexRange columns = grid::intervals_touched(tiles.x, x.lo, x.hi);
  const grid::IndexRange rows = grid::descending_intervals_touched(tiles.y, y.lo, y.hi);
  const grid::IndexRange slices = grid::intervals_touched(depths, depth - ball.radius, depth + ball.radius);
  return {{columns.first, rows.first, slices.first}, {columns.last, rows.last, slices.last}};
}

}  // namespace clusterbench::assign
