#pragma once
// The values of a ball that all slices and rows share. Orthographic grids need only the ball itself.
//
// In the coordinates x / depth, y / depth and 1 / depth, columns, rows and slices are slabs between parallel planes,
// and a ball in front of the eye is an ellipsoid. The touch points of the eye's tangents follow from a few numbers of
// the ball.

#include <cstdint>

#include "assign/grid_cull/frustum_cull.h"
#include "core/aligned_vector.h"
#include "core/arrays.h"

namespace clusterbench::assign {

// Numbers of each ball side by side, in groups of four, for lookups by scattered indices. Keeps its memory between
// frames.
struct SphereSetup {
  static constexpr float k_at_eye = 1e30f;  // the inverse depth for a touch at no depth ahead of the eye

  AlignedVector<float> sphere;    // x, y, depth and radius, with slack
  AlignedVector<float> touch;     // slack; the light (an integer's bits); lean and inverse_upright
  AlignedVector<float> extremes;  // 1 / depth where the ball is farthest left, right, down and up in the picture

  std::size_t capacity_bytes() const { return bytes_of(sphere, touch, extremes); }
};

// Sets up the first `count` visible balls.
//
// The tangents from the eye to the circle that a tile plane of slope v cuts out touch it at the inverse depths (depth +
// y v -+ lean s) * inverse_upright, with s² = radius² (1 + v²) - (y - v depth)². lean is x by the length of a tangent
// from the eye to the ball, inverse_upright is 1 / (depth² + y² - radius²), or 0 where that is not precise enough to
// locate the touch. For balls around the eye, which have no tangents, inverse_upright is infinite and lean 0. For the
// required precision see Certainty in slice_rows.cpp. Balls whose surface nearly goes through the eye, or as a circle
// seen from the side or from above, are made a little larger, and their slack.
void set_up_spheres(const VisibleBalls& visible, std::uint32_t count, SphereSetup& out);

}  // namespace clusterbench::assign
