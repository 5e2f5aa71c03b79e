#pragma once
// The shapes that lights and cells are. Lengths in metres, angles in radians.
// Cells are closed sets bounded by the given single-precision numbers, taken exactly.

#include <variant>

#include "geom/vec.h"

namespace clusterbench::geom {

// A piece of a view frustum in view space (x right, y up, camera looks down -z; depth = -z):
// perspective:  x0*depth <= x <= x1*depth, y0*depth <= y <= y1*depth, depth0 <= depth <= depth1
// orthographic: x0 <= x <= x1, y0 <= y <= y1, depth0 <= depth <= depth1
struct FrustumPiece {
  float x0, x1, y0, y1;  // slopes (perspective) or metres (orthographic), ascending
  float depth0, depth1;  // ascending; >= 0 for perspective
  bool orthographic;
};

// A pyramid through the eye cut by two shells: x0*depth <= x <= x1*depth, y0*depth <= y <= y1*depth, depth >= 0,
// distance0 <= |p| <= distance1.
struct ShellPiece {
  float x0, x1, y0, y1;
  float distance0, distance1;
};

struct Box {
  Vec3f lo, hi;
};

using Cell = std::variant<FrustumPiece, ShellPiece, Box>;

// A light's volume in the space of a grid, single precision.
struct Ball {
  Vec3f center;
  float radius;
};

// ball(apex, range) ∩ solid cone around `axis` (unit length), half-angle in [0, 90°].
struct SphericalCone {
  Vec3f apex;
  float range;
  Vec3f axis;
  float cos_angle, sin_angle;  // both kept: sqrt(1-cos²) is wrong by 100 % at 0.01°
};

}  // namespace clusterbench::geom
