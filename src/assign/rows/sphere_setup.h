#pragma once
// What all slices and rows of a ball share. Of orthographic grids only the ball itself counts.
//
// In the coordinates x / depth, y / depth and 1 / depth, columns, rows and slices are slabs between parallel planes,
// and a ball that is before the eye is an ellipsoid. Where the eye's tangents touch it follows from a few numbers of
// the ball.

#include <cstdint>

#include "assign/grid_cull/frustum_cull.h"
#include "core/aligned_vector.h"
#include "core/arrays.h"

namespace clusterbench::assign {

// Numbers of each ball side by side, four and four, for whoever takes them by scattered indices. Keeps its memory
// between frames.
struct SphereSetup {
  static constexpr float k_at_eye = 1e30f;  // the inverse depth of what is touched at no depth ahead of the eye

  AlignedVector<float> sphere;    // x, y, depth and radius, with slack
  AlignedVector<float> touch;     // slack; the light (an integer's bits); lean and inverse_upright
  AlignedVector<float> extremes;  // 1 / depth where the ball is farthest left, right, down and up in the picture

  std::size_t capacity_bytes() const { return bytes_of(sphere, touch, extremes); }
};

// Of the first `count` visible balls.
//
// The tangents from the eye to the circle that a tile plane of slope v cuts out touch it at the inverse depths
// (depth + y v -+ lean s) * inverse_upright, with s² = radius² (1 + v²) - (y - v depth)². lean is x by the length of a
// tangent from the eye to the ball, inverse_upright 1 / (depth² + y² - radius²), and 0 where that is not precise enough
// to say where; for balls around the eye, which nothing touches, it is infinite, and lean 0. How precise it needs to
// be: see Certainty in slice_rows.cpp. Balls whose surface nearly goes through the eye, or as a circle seen from the
// side or from above, are made a little larger, and their slack.
void set_up_spheres(const VisibleBalls& visible, std::uint32_t count, SphereSetup& out);

}  // namespace clusterbench::assign
