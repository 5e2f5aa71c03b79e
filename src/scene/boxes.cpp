// Oriented boxes as lights.

#include <algorithm>
#include <cmath>

#include "scene/scene.h"

namespace clusterbench::scene {

void assign_boxes(Scene& scene) {
  for (const OrientedBox& box : scene.boxes) {
    Light light;
    light.name = box.name;
    light.type = LightType::box;
    light.node = box.node;
    light.intensity = 0.0;
    light.half_extents_m = box.half_extents_m;
    light.range_m = glm::length(box.half_extents_m);
    scene.lights.push_back(std::move(light));
  }
}

double corner_distance_m(const std::array<Vec3d, 3>& half_axes_m) {
  // Four corners; the others are opposite to them. Scaled, so that no square overflows or vanishes.
  const auto largest_of = [](const Vec3d& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); };
  const double largest = std::max({largest_of(half_axes_m[0]), largest_of(half_axes_m[1]), largest_of(half_axes_m[2])});
  if (!(largest > 0.0) || !std::isfinite(largest)) return largest;
  double farthest = 0.0;
  for (const double second : {-1.0, 1.0})
    for (const double third : {-1.0, 1.0})
      farthest = std::max(farthest, glm::length(half_axes_m[0] / largest + second * (half_axes_m[1] / largest) +
                                                third * (half_axes_m[2] / largest)));
  constexpr double k_more = 1.0 + 0x1p-46;  // more than the rounding of all these operations
  return farthest * largest * k_more;
}

}  // namespace clusterbench::scene
