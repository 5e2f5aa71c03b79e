#pragma once
// Cones against the balls around cells, a vector of cells at a time: geom::cone_touches_ball, the same operations in
// the same order.

#include <cstdint>
#include <span>
#include <vector>

#include "core/arrays.h"
#include "geom/shapes/ball_and_cone.h"

namespace clusterbench::assign {

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
