#pragma once
// Bounding spheres, many at once: spheres around spots, and tests of a cone against the spheres around cells. Both do
// the same operations in the same order as LightArrays::bounding_ball() and geom's cone_touches_ball().

#include <cstdint>
#include <span>
#include <vector>

#include "assign/grid_cull/frustum_cull.h"
#include "core/arrays.h"
#include "geom/shapes/ball_and_cone.h"
#include "view/frame.h"

namespace clusterbench::assign {

// Balls as one array per coordinate. The arrays have room for whole vectors after the last ball.
struct BallArrays {
  std::vector<float> x, y, z, radius;

  std::size_t capacity_bytes() const { return bytes_of(x, y, z, radius); }
};

// Ball i bounds spot i and is enlarged by `roundoffs`. With `around_cones` it bounds the cone, otherwise the ball of
// the range. Spots without volume get radius 0.
void find_spot_balls(const view::LightArrays& lights, float roundoffs, bool around_cones, BallArrays& balls);

inline GivenBalls given_points(const view::LightArrays& lights) {
  return {lights.x.data(), lights.y.data(), lights.z.data(), lights.radius.data(), lights.reach.data(), lights.points};
}
// `balls`: the balls of all spots.
inline GivenBalls given_spots(const view::LightArrays& lights, const BallArrays& balls) {
  return {balls.x.data(), balls.y.data(), balls.z.data(), balls.radius.data(), lights.reach.data() + lights.spots.first,
          lights.spots};
}

// The bounding balls of a grid's cells. All arrays have room for whole vectors after the last cell.
struct CellBalls {
  std::vector<float> x, y, z, radius, size;  // size: |x| + |y| + |z|

  explicit CellBalls(std::span<const geom::Ball> balls);
  CellBalls() = default;
  bool empty() const { return x.empty(); }
  std::size_t capacity_bytes() const { return bytes_of(x, y, z, radius, size); }
};

// Neighbouring cells of a row, at most 64.
struct CellRun {
  std::uint32_t row, column;  // of the first cell
  std::uint32_t cell, count;  // index of the first cell, number of cells
};

// touched[i] has one bit for each cell of runs[i], the lowest bit for the first cell. It is set if the cone may touch
// the cell.
void find_touched_cells(const geom::SphericalCone& cone, const CellBalls& cells, std::span<const CellRun> runs,
                        std::vector<std::uint64_t>& touched);

}  // namespace clusterbench::assign
