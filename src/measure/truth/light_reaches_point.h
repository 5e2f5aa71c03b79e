#pragma once
// Whether a light reaches a point, in double precision; a point exactly at the end of its range, or on its cone, is
// reached.

#include <cmath>
#include <glm/geometric.hpp>

#include "scene/scene.h"

namespace clusterbench::measure {

// `to_point`: from the light.
inline bool is_in_range(const scene::WorldLight& light, const Vec3d& to_point) {
  return light.range_m != 0.0 && !(glm::length(to_point) > light.range_m);
}

// True for a light that is not a spot.
inline bool is_in_cone(const scene::WorldLight& light, const Vec3d& to_point) {
  if (light.type != scene::LightType::spot) return true;
  // By the components of the vector along and across the axis: the cosine of a cone below 1e-8 rad rounds to that of 0.
  const double along = glm::dot(to_point, light.direction), across = glm::length(glm::cross(to_point, light.direction));
  return along >= 0.0 && std::cos(light.outer_cone_rad) * across <= std::sin(light.outer_cone_rad) * along;
}

inline bool reaches(const scene::WorldLight& light, const Vec3d& to_point) {
  return is_in_range(light, to_point) && is_in_cone(light, to_point);
}

}  // namespace clusterbench::measure
