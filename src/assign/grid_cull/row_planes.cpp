#include "assign/grid_cull/row_planes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "assign/grid_cull/frustum_cull.h"
#include "assign/simd/lanes.h"

namespace clusterbench::assign {
namespace {

// Tiles per slope along one axis, and the error, in tiles, of (slope - first plane) * scale: planes are rounded, so
// they are not quite evenly spaced, and the last tile may be clipped; then difference and product are rounded.
struct Scale {
  float tiles_per_slope, tolerance;
};

Scale scale_of(const std::vector<float>& planes) {
  const std::size_t tiles = planes.size() - 1, even = std::max<std::size_t>(1, tiles - 1);
  const auto from_first = [&](std::size_t i) {
    return std::fabs(static_cast<double>(planes[i]) - static_cast<double>(planes[0]));
  };
  const auto scale = static_cast<float>(static_cast<double>(even) / from_first(even));
  double off = 0.0;
  for (std::size_t i = 0; i <= even; ++i)
    off = std::max(off, std::fabs(from_first(i) * static_cast<double>(scale) - static_cast<double>(i)));
  const double rounding = 0x1p-22 * static_cast<double>(tiles + 1);
  return {scale, static_cast<float>(1.1 * off + rounding)};
}

float least_reach_of(const RowPlanes& planes) {
  constexpr float k_least_normal = 1e-7f, k_ways = 16.0f, k_none = std::numeric_limits<float>::infinity();
  const float across = std::max(std::fabs(planes.left), std::fabs(planes.right));
  const float up =
      std::max(std::fabs(planes.slope.front()), std::fabs(planes.slope[static_cast<std::size_t>(planes.rows)]));
  const float farthest = std::max(std::fabs(planes.depth.front()), std::fabs(planes.depth.back()));
  if (farthest > k_most_row_reach) return k_none;
  if (planes.orthographic) return std::max(across, up) <= k_most_row_reach ? k_least_normal : k_none;
  if (planes.depth[1] < RowPlanes::k_least_slice_m || std::max(across, up) > RowPlanes::k_most_slope) return k_none;
  if (planes.inverse_depth.front() <= RowPlanes::k_most_inverse_depth) return k_least_normal;
  const float longest_way = std::sqrt(1.0f + across * across + up * up) / RowPlanes::k_most_inverse_depth;
  return std::max(k_least_normal, k_ways * longest_way / (k_slice_rows_roundoffs * 0x1p-24f));
}

}  // namespace

RowPlanes::RowPlanes(const grid::ScreenGrid& grid)
    : orthographic(grid.tiles.orthographic),
      rows(grid.tiles.count.y),
      columns(grid.tiles.count.x),
      slices(grid.slices.count()),
      left(grid.tiles.x.front()),
      right(grid.tiles.x.back()) {
  const Scale across = scale_of(grid.tiles.x), down = scale_of(grid.tiles.y);
  columns_per_slope = across.tiles_per_slope;
  column_tolerance = across.tolerance;
  rows_per_slope = down.tiles_per_slope;
  row_tolerance = down.tolerance;
  slope = grid.tiles.y;
  side = grid.tiles.x;
  for (std::vector<float>* list : {&slope, &side}) list->resize(list->size() + k_most_lanes);
  for (const float z : grid.slices.boundaries) {
    depth.push_back(z);
    inverse_depth.push_back(z > 0.0f ? 1.0f / z : 1e30f);  // at the eye every slope but 0 is beyond the picture
  }
  searched.assign(depth.begin(), depth.end() - 1);
  searched.resize(std::bit_ceil(searched.size()), std::numeric_limits<float>::infinity());
  least_reach = least_reach_of(*this);
}

}  // namespace clusterbench::assign
