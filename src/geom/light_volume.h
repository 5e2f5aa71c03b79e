#pragma once
// The volume of a light: a ball, or (a spot) the part of it in a cone around an axis.

#include "geom/placement.h"

namespace clusterbench::geom {

// A light by its exact ingredients. The axis is rotation * direction, not necessarily of unit length.
struct LightVolume {
  Placement apex;
  double range = 0.0;  // > 0, may be +inf
  bool is_cone = false;
  Vec3d direction{0.0, 0.0, -1.0};
  double half_angle_rad = 0.0;
};

}  // namespace clusterbench::geom
