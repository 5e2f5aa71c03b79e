#pragma once
// An oriented box against a cell in single precision: the tests of engines for decals and probes. Touching counts. Each
// test says no only if it has found a direction in which box and cell are separated by more than rounding, so all of
// them are conservative.
//
// Padding is in metres: u times the box's reach, |x| + |y| + |z| + r of its middle and of the ball around it, for each
// roundoff (u = 2^-24) that a test can add up to. The tests themselves add the roundoffs of the cell's own numbers.

#include <array>

#include "geom/shapes/ball_and_cone.h"
#include "geom/shapes/cell.h"

namespace clusterbench::geom {

// The numbers of a box that do not depend on the cell.
struct PaddedBox {
  OrientedBox box;
  float padding = 0.0f;
  Vec3f extent{0.0f};                    // along x, y and z from the middle, padded
  std::array<Vec3f, 3> across{};         // the normals of its faces, unit up to rounding; 0 for faces without area
  std::array<float, 3> across_extent{};  // the box's extents along them, padded
};
PaddedBox padded(const OrientedBox& box, float padding);

// The box's axis-aligned bounds against a cell's: the coarse test.
//
// Roundoffs: half axes and the sums of their coordinates 3 of the extents, the middle 1, its sums with the extents 3.
inline constexpr float k_bounds_roundoffs = 7.0f;
bool bounds_touch(const PaddedBox& box, const Box& cell);

// The cell's bounds in the box's own space, and their bounds there, against the box. Scaled so that lengths are
// preserved: a decal may have a thickness of 0.
//
// Roundoffs: the middle 1, half axes 2 (their lengths add up to no more than sqrt(3) r), their padded sum 2.
inline constexpr float k_box_space_roundoffs = 5.0f;
bool bounds_touch_in_box_space(const PaddedBox& box, const Box& cell);

// The box against the four sides of a frustum cell.
//
// Roundoffs, each of (1 + the side's slope) times the reach: the middle 3, half axes and the sums of them 5, the
// difference 1.
inline constexpr float k_sides_roundoffs = 9.0f;
bool touches_sides(const PaddedBox& box, const FrustumCell& cell);

// The separating-axis test against the frustum cell itself (Gottschalk, Lin and Manocha 1996): depths, the cell's
// sides, the normals of the box's faces, and the directions orthogonal to an edge of each. It tests all necessary
// directions, so it is wrong by no more than padding. Any vector is a valid direction, so rounding errors in the
// direction's computation do not matter.
//
// Roundoffs along a direction, of its largest coordinate times the reach: the middle 5, half axes (given, products and
// sums) 18, the difference 1.
inline constexpr float k_separating_axis_roundoffs = 24.0f;
bool no_axis_separates(const PaddedBox& box, const FrustumCell& cell);

}  // namespace clusterbench::geom
