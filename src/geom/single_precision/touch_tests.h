#pragma once
// The scalar single-precision predicates: the readable reference with which every SIMD variant must agree. Touching
// counts. A function marked "conservative" never returns false for shapes that touch, if the error of its inputs is no
// more than single-precision rounding of their coordinates.

#include "geom/shapes/ball_and_cone.h"
#include "geom/shapes/cell.h"
#include "geom/single_precision/plane.h"

namespace clusterbench::geom {

// Ball against an axis-aligned box: the box's nearest point to the centre (Arvo 1990).
bool ball_touches_box(const Ball& ball, const Box& box);

// Ball against a convex polytope given by planes that point outward: true unless one plane has the whole ball outside.
// Also true for some balls near an edge or corner that no single plane can exclude.
bool ball_touches_planes(const Ball& ball, const Plane* planes, int count);

// Sphere-capped cone against ball; conservative. Says false only if the ball lies beyond the cone's side, beyond its
// range, or behind its apex.
bool cone_touches_ball(const SphericalCone& cone, const Ball& ball);

}  // namespace clusterbench::geom
