#pragma once

#include <cmath>

#include "geom/shapes/vec.h"

namespace clusterbench::geom {

// In radians, 0 to pi: precise for small angles and for those near pi, too. Vectors may have any length but 0.
inline double angle_between(const Vec3d& a, const Vec3d& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace clusterbench::geom
