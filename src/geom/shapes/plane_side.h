#pragma once
// On which side of a triangle's plane a point lies, exactly: Shewchuk 1997, "Adaptive Precision Floating-Point
// Arithmetic and Fast Robust Geometric Predicates" (orient3d), with a filter in double precision before exact numbers.

#include "geom/shapes/vec.h"

namespace clusterbench::geom {

// 1: a, b, c are counter-clockwise as seen from p, that is, p is in front; -1: p is behind; 0: p is in the plane, or
// the triangle has no area. For the numbers as given: finite, at most 1e15.
int side_of_plane(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& p);

}  // namespace clusterbench::geom
