#pragma once
// Boxes, balls and planes around cells and spots, in single precision, rounded outward.
#include "geom/shapes/ball_and_cone.h"
#include "geom/shapes/cell.h"
#include "geom/single_precision/plane.h"

namespace clusterbench::geom {

// The planes of a frustum piece, pointing outward: left, right, bottom, top, near, far.
void outward_planes(const FrustumPiece& cell, Plane (&planes)[6]);

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
