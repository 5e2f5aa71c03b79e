#pragma once
// Lights in the space of a grid, in single precision. Lengths in metres, angles in radians.

#include <array>

#include "geom/shapes/vec.h"

namespace clusterbench::geom {

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
  float cos_angle, sin_angle;  // both are stored: sqrt(1-cos²) is wrong by 100 % at 0.01°
};

// From a box's middle to the middles of three of its faces. Orthogonal, except under a sheared scene node.
using HalfAxes = std::array<Vec3f, 3>;

// All points center + a * axes[0] + b * axes[1] + c * axes[2] with a, b and c from -1 to 1.
struct OrientedBox {
  Vec3f center;
  HalfAxes axes;
};

}  // namespace clusterbench::geom
