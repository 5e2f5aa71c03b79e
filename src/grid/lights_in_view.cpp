#include "grid/lights_in_view.h"

#include <algorithm>
#include <cmath>

namespace clusterbench::grid {

namespace {

double length_of_normal(const view::Projection& projection, double side) {
  return projection.orthographic ? 1.0 : std::sqrt(1.0 + side * side);
}

bool is_in_view(const view::Frame& frame, const ViewPlanes& planes, const scene::WorldLight& light) {
  if (!(light.range_m > 0.0)) return false;
  if (!std::isfinite(light.range_m)) return true;
  const WorldBall around = ball_around(light);
  const Vec3d center = frame.view_space.rotation * (around.center - frame.view_space.origin);
  return planes.may_see(center, around.radius_m + slack_of(center, light.range_m));
}

}  // namespace

Vec3d in_view_space(const view::Frame& frame, const scene::WorldLight& light) {
  return frame.view_space.rotation * (light.position - frame.view_space.origin);
}

ViewPlanes::ViewPlanes(const view::Projection& projection)
    : projection_(projection),
      length_{length_of_normal(projection, projection.left), length_of_normal(projection, projection.right),
              length_of_normal(projection, projection.bottom), length_of_normal(projection, projection.top)} {}

bool ViewPlanes::may_see(const Vec3d& center, double radius) const {
  const double depth = -center.z;
  if (depth + radius < projection_.near_m || depth - radius > projection_.far_m) return false;
  const auto beyond = [&](double coordinate, double side, double length) {
    return projection_.orthographic ? coordinate - side : (coordinate - side * depth) / length;
  };
  return -beyond(center.x, projection_.left, length_[0]) <= radius &&
         beyond(center.x, projection_.right, length_[1]) <= radius &&
         -beyond(center.y, projection_.bottom, length_[2]) <= radius &&
         beyond(center.y, projection_.top, length_[3]) <= radius;
}

WorldBall ball_around(const scene::WorldLight& light) {
  if (light.type != scene::LightType::spot) return {light.position, light.range_m};
  const double cosine = std::cos(light.outer_cone_rad), sine = std::sin(light.outer_cone_rad);
  if (cosine > sine) {  // below 45 degrees: through the apex and the rim
    const double radius = light.range_m / (2.0 * cosine);
    return {light.position + radius * light.direction, radius};
  }
  return {light.position + light.range_m * cosine * light.direction, light.range_m * sine};
}

bool is_in_view(const view::Frame& frame, const scene::WorldLight& light) {
  return is_in_view(frame, ViewPlanes(frame.projection), light);
}

std::vector<bool> lights_in_view(const view::Frame& frame) {
  const ViewPlanes planes(frame.projection);
  std::vector<bool> out;
  out.reserve(frame.lights.size());
  for (const scene::WorldLight& light : frame.lights) out.push_back(is_in_view(frame, planes, light));
  return out;
}

double slack_of(const Vec3d& center, double range_m) {
  return 0x1p-40 * (glm::length(center) + range_m);
}

WorldBox box_around(const scene::WorldLight& light) {
  const double r = light.range_m;
  const Vec3d padding(0x1p-40 * (glm::length(light.position) + r));
  if (light.type == scene::LightType::box) {
    const Vec3d reach =
        glm::abs(light.half_axes_m[0]) + glm::abs(light.half_axes_m[1]) + glm::abs(light.half_axes_m[2]) + padding;
    return {light.position - reach, light.position + reach};
  }
  if (light.type != scene::LightType::spot) return {light.position - r - padding, light.position + r + padding};
  const double beside = r * std::sin(light.outer_cone_rad);
  WorldBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const double along = light.direction[axis], next = light.direction[(axis + 1) % 3],
                 other = light.direction[(axis + 2) % 3];
    const double across = std::sqrt(next * next + other * other);
    box.lo[axis] = light.position[axis] + std::min(0.0, r * along) - beside * across - padding[axis];
    box.hi[axis] = light.position[axis] + std::max(0.0, r * along) + beside * across + padding[axis];
  }
  return box;
}

std::optional<WorldBox> box_around_lights_in_view(const view::Frame& frame) {
  WorldBox all;
  bool is_first = true;
  const ViewPlanes planes(frame.projection);
  for (const scene::WorldLight& light : frame.lights) {
    if (!is_in_view(frame, planes, light)) continue;
    if (!std::isfinite(light.range_m)) return std::nullopt;
    const WorldBox box = box_around(light);
    all.lo = is_first ? box.lo : glm::min(all.lo, box.lo);
    all.hi = is_first ? box.hi : glm::max(all.hi, box.hi);
    is_first = false;
  }
  return all;
}

}  // namespace clusterbench::grid
