#pragma once
// Boxes, balls and planes around cells and spots, in single precision, rounded outward.

#include "geom/shapes/ball_and_cone.h"
#include "geom/shapes/cell.h"
#include "geom/single_precision/plane.h"

namespace clusterbench::geom {

// The planes of a frustum cell, pointing outward: left, right, bottom, top, near, far.
void outward_planes(const FrustumCell& cell, Plane (&planes)[6]);

// The smallest ball around a sphere-capped cone, rounded up; conservative.
// Half-angle below 45°: through the apex and the rim, radius range / (2 cos a); above: around the rim's circle. Larger
// by `padding`, for the roundoffs of whoever tests it.
Ball bounding_ball(const SphericalCone& cone, float padding = 0.0f);

// The smallest axis-aligned box around a frustum cell, rounded outward.
Box box_around(const FrustumCell& cell);

// An axis-aligned box around a cell, rounded outward. For a shell cell: around the part of its pyramid between its
// least and greatest possible depth.
Box box_around(const Cell& cell);

// A small ball around a cell, rounded up. For a shell cell: around the part of its pyramid between its least and
// greatest possible depth.
Ball ball_around(const Cell& cell);

}  // namespace clusterbench::geom
