#pragma once
// Balls with the box of cells that each may touch, as one array per field: the result of culling, and the input for the
// slices' rows.

#include <cstdint>

#include "assign/simd/lanes.h"
#include "core/aligned_vector.h"
#include "core/arrays.h"
#include "geom/shapes/vec.h"

namespace clusterbench::assign {

// A box of cells, neighbours along all three axes.
struct CellBox {
  Vec3i first{0}, last{-1};  // inclusive

  bool empty() const { return first.x > last.x || first.y > last.y || first.z > last.z; }
};

// Ascending by light. All arrays have room for whole vectors beyond `count`.
struct BoundedBalls {
  std::uint32_t count = 0;
  AlignedVector<float> x, y, depth, radius;
  AlignedVector<std::uint32_t> light;
  AlignedVector<std::int32_t> first_column, last_column, first_row, last_row, first_slice, last_slice;

  CellBox box(std::uint32_t ball) const {
    return {{first_column[ball], first_row[ball], first_slice[ball]},
            {last_column[ball], last_row[ball], last_slice[ball]}};
  }
  // An empty box reaches no slice.
  void set_box(std::uint32_t ball, const CellBox& box) {
    first_column[ball] = box.first.x;
    last_column[ball] = box.last.x;
    first_row[ball] = box.first.y;
    last_row[ball] = box.last.y;
    first_slice[ball] = box.first.z;
    last_slice[ball] = box.empty() ? box.first.z - 1 : box.last.z;
  }
  void reserve(std::uint32_t most) {
    grow_to(most + k_most_lanes, x, y, depth, radius, light, first_column, last_column, first_row, last_row,
            first_slice, last_slice);
  }
  std::size_t capacity_bytes() const {
    return bytes_of(x, y, depth, radius, light, first_column, last_column, first_row, last_row, first_slice,
                    last_slice);
  }
};

// One batch: indices in `bounded`, from which a whole vector can be read; `count` of them, at most balls_per_batch(),
// are valid. All rows of lights from `first_uncertain` on are marked as uncertain, because they need another test.
struct BallBatch {
  const BoundedBalls& bounded;
  int slice;
  const std::uint32_t* balls;
  std::uint32_t count, first_uncertain;
};

}  // namespace clusterbench::assign
