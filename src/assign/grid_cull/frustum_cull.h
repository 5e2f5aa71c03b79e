#pragma once
// Many balls at once: culls those outside of a frustum grid, and finds the slices that the others may reach.

#include <cstdint>

#include "assign/grid_cull/row_planes.h"
#include "assign/simd/lanes.h"
#include "core/aligned_vector.h"
#include "core/arrays.h"

namespace clusterbench::assign {

// The balls of lights of one type, one array per coordinate.
struct GivenBalls {
  const float *x, *y, *z, *radius, *reach;
  view::LightRange lights;
};

// Balls that may touch cells, ascending by light. All arrays have room for whole vectors beyond `count`.
struct VisibleBalls {
  std::uint32_t count = 0;
  AlignedVector<float> x, y, depth;
  AlignedVector<float> radius;  // with slack
  AlignedVector<float> slack;
  AlignedVector<std::uint32_t> light;
  AlignedVector<std::int32_t> first_slice, last_slice;

  void reserve(std::uint32_t most) {
    grow_to(most + k_most_lanes, x, y, depth, radius, slack, light, first_slice, last_slice);
  }
  std::size_t capacity_bytes() const { return bytes_of(x, y, depth, radius, slack, light, first_slice, last_slice); }
};

// Units of 2^-24 of a light's reach by which a ball is enlarged: more than rounding loses here (a centre 1, distances
// to planes 3) and in the rows (see Certainty in slice_rows.cpp). A larger slack only adds decisions.
inline constexpr float k_slice_rows_roundoffs = 28.0f;

// Beyond this reach, or below RowPlanes::least_reach, powers of it may overflow or underflow: such balls become balls
// of infinite radius around the eye, and their rows are decided exactly.
inline constexpr float k_most_row_reach = 1e9f;

// Appends the balls that may reach into the grid. The others touch no cell, even if they are enlarged by these
// roundoffs.
void cull_balls(const RowPlanes& planes, const GivenBalls& balls, VisibleBalls& visible,
                float roundoffs = k_slice_rows_roundoffs);

}  // namespace clusterbench::assign
