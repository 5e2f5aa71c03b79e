#pragma once
// Cones against the balls around cells, a vector of cells at a time: geom::cone_touches_ball, the same operations in
// the same order.

#include <cstdint>
#include <span>
#include <vector>

#include "geom/shapes.h"

namespace clusterbench::assign {

// The balls around a grid's cells. All arrays have room for whole vectors beyond the last.
struct CellBalls {
  std::vector<float> x, y, z, radius, size;  // size: |x| + |y| + |z|

  explicit CellBalls(std::span<const geom::Ball> balls);
  CellBalls() = default;
  bool empty() const { return x.empty(); }
  std::size_t capacity_bytes() const;
};

// Bit i: whether the cone may touch cell first + i, i < count; at most 64.
std::uint64_t lit_cells(const geom::SphericalCone& cone, const CellBalls& cells, std::uint32_t first,
                        std::uint32_t count);

}  // namespace clusterbench::assign
