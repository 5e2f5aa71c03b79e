#pragma once
// Bounding spheres, many at once: those around spots, and cones against those around cells. Both are what
// geom/single_precision has (bounding_ball of LightArrays::cone, cone_touches_ball), the same operations in the same
// order.

#include <cstdint>
#include <span>
#include <vector>

#include "assign/grid_cull/frustum_cull.h"
#include "core/arrays.h"
#include "geom/shapes/ball_and_cone.h"
#include "view/frame.h"

namespace clusterbench::assign {

// Balls in arrays, with room for whole vectors beyond the last.
struct BallArrays {
  std::vector<float> x, y, z, radius;

  std::size_t capacity_bytes() const { return bytes_of(x, y, z, radius); }
};

// Ball i is that of spot i, larger by these roundoffs: around its cone or, if not `around_cones`, the ball of its
// range. Spots without volume get radius 0.
void find_spot_balls(const view::LightArrays& lights, float roundoffs, bool around_cones, BallArrays& balls);

inline GivenBalls given_points(const view::LightArrays& lights) {
  return {lights.x.data(), lights.y.data(), lights.z.data(), lights.radius.data(), lights.reach.data(), lights.points};
}
// `balls`: those of all spots.
inline GivenBalls given_spots(const view::LightArrays& lights, const BallArrays& balls) {
  return {balls.x.data(), balls.y.data(), balls.z.data(), balls.radius.data(), lights.reach.data() + lights.spots.first,
          lights.spots};
}

// The balls around a grid's cells. All arrays have room for whole vectors beyond the last.
struct CellBalls {
  std::vector<float> x, y, z, radius, size;  // size: |x| + |y| + |z|

  explicit CellBalls(std::span<const geom::Ball> balls);
  CellBalls() = default;
  bool empty() const { return x.empty(); }
  std::size_t capacity_bytes() const { return bytes_of(x, y, z, radius, size); }
};

// Neighbouring cells of a row, at most 64.
struct CellRun {
  std::uint32_t row, column;  // of the first one
  std::uint32_t cell, count;  // its index, and how many
};

// touched[i]: a bit for each cell of runs[i], the lowest for the first: whether the cone may touch it.
void find_touched_cells(const geom::SphericalCone& cone, const CellBalls& cells, std::span<const CellRun> runs,
                        std::vector<std::uint64_t>& touched);

}  // namespace clusterbench::assign
