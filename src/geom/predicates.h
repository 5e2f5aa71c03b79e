#pragma once
// The scalar single-precision predicates: the readable reference that every faster twin must agree with.
// Touching counts. Where a function says "conservative" it never answers false for shapes that touch, given inputs that
// carry no more than single-precision rounding of their coordinates.

#include "geom/shapes.h"

namespace clusterbench::geom {

// Ball against an axis-aligned box: the box's nearest point to the centre (Arvo 1990).
bool ball_touches_box(const Ball& ball, const Box& box);

// A plane n·p = offset with unit normal n.
struct Plane {
  Vec3f normal;
  float offset;
};

// Ball against a convex polytope given by planes that point outward: no plane has the whole ball outside. Says true for
// balls near an edge or corner that only each plane alone cannot exclude.
bool ball_touches_planes(const Ball& ball, const Plane* planes, int count);

// The planes of a frustum piece, pointing outward: left, right, bottom, top, near, far.
void outward_planes(const FrustumPiece& cell, Plane (&planes)[6]);

// Sphere-capped cone against ball; conservative. Says false only if the ball lies beyond the cone's side, beyond its
// range, or behind its apex.
bool cone_touches_ball(const SphericalCone& cone, const Ball& ball);

// The smallest ball that holds a sphere-capped cone, rounded up; conservative.
// Half-angle below 45°: through the apex and the rim, radius range / (2 cos a); above: around the rim's circle.
Ball bounding_ball(const SphericalCone& cone);

// The smallest axis-aligned box around a frustum piece, rounded outward.
Box box_around(const FrustumPiece& cell);

// An axis-aligned box around a cell, rounded outward; of a shell piece one around the pyramid piece between the depths
// that it can have.
Box box_around(const Cell& cell);

// A small ball around a cell, rounded up. A shell piece's holds the pyramid piece between the depths that it can have.
Ball ball_around(const Cell& cell);

}  // namespace clusterbench::geom
