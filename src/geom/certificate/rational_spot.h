#pragma once
// Does a spot's volume share a point with a cell? Checks in exact arithmetic for proposed evidence: a common point, or
// a plane between the two. The cosine of the half-angle is not rational; a bound is used in its place, each time the
// bound that makes the check harder to pass.

#include <array>

#include "geom/numbers/rational_trigonometry.h"
#include "geom/shapes/light_volume.h"
#include "geom/shapes/rational_cell.h"

namespace clusterbench::geom {

// ball(apex, range) ∩ solid cone around direction (any length but 0).
struct ExactSpot {
  RationalPoint apex, direction;
  Rational range;  // metres
  Rational half_angle_rad;
  AngleBounds half_angle;
};

// An infinite range becomes the largest double. Angles above 90° are taken as 90°.
// angle_bits: precision of the half-angle's cosine and sine.
ExactSpot exact_spot(const SpotVolume& light, unsigned angle_bits = 320);

// Is the angle between v and the axis certainly at most the half-angle?
bool surely_leans(const ExactSpot& spot, const RationalPoint& v);
// Is p certainly in the volume?
bool surely_holds(const ExactSpot& spot, const RationalPoint& p);

// Does a plane with this normal (from the volume to the corners; any length) certainly lie between the volume and the
// convex hull of the corners, touching neither?
bool surely_separates(const RationalPoint& normal, const ExactSpot& spot, const std::array<RationalPoint, 8>& corners);

}  // namespace clusterbench::geom
