#include "view/frame.h"

#include <cassert>
#include <cmath>
#include <string>

#include "core/error.h"
#include "geom/rounding.h"

namespace clusterbench::view {
namespace {

bool is_finite(const scene::CameraPose& pose) {
  double sum = std::abs(pose.eye.x) + std::abs(pose.eye.y) + std::abs(pose.eye.z);
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) sum += std::abs(pose.view_from_world[column][row]);
  return std::isfinite(sum);
}

void add_axis(LightArrays& out, const Mat3d& rotation, const scene::WorldLight& light) {
  const Vec3d axis = rotation * light.direction;
  const double length = std::sqrt(axis.x * axis.x + axis.y * axis.y + axis.z * axis.z);
  out.axis_x.push_back(static_cast<float>(axis.x / length));
  out.axis_y.push_back(static_cast<float>(axis.y / length));
  out.axis_z.push_back(static_cast<float>(axis.z / length));
  out.cos_angle.push_back(static_cast<float>(std::cos(light.outer_cone_rad)));
  out.sin_angle.push_back(static_cast<float>(std::sin(light.outer_cone_rad)));
}

}  // namespace

Projection make_projection(const scene::Lens& lens, Vec2i viewport) {
  if (lens.sides)
    return {false, lens.sides->left, lens.sides->right, lens.sides->bottom, lens.sides->top, lens.near_m, lens.far_m};
  const double aspect = static_cast<double>(viewport.x) / viewport.y;
  const double top = lens.orthographic ? lens.ymag_m : std::tan(lens.yfov_rad / 2.0);
  return {lens.orthographic, -top * aspect, top * aspect, -top, top, lens.near_m, lens.far_m};
}

float LightArrays::padded_radius(std::uint32_t light, float roundings) const {
  if (roundings == 0.0f || is_empty(light)) return radius[light];
  constexpr float k_rounding = 0x1p-24f;
  return radius[light] + roundings * (k_rounding * reach[light]);
}

geom::Ball LightArrays::ball(std::uint32_t light, float roundings) const {
  return {{x[light], y[light], z[light]}, padded_radius(light, roundings)};
}

geom::SphericalCone LightArrays::cone(std::uint32_t light, float roundings) const {
  assert(is_spot(light));
  const std::uint32_t spot = light - points;
  return {{x[light], y[light], z[light]},
          padded_radius(light, roundings),
          {axis_x[spot], axis_y[spot], axis_z[spot]},
          cos_angle[spot],
          sin_angle[spot]};
}

geom::LightVolume LightArrays::volume(std::uint32_t light) const {
  return volume_of(source[light], space);
}

geom::LightVolume volume_of(const scene::WorldLight& light, const Space& space) {
  return {{light.position, space.origin, space.rotation},
          light.range_m,
          light.type == scene::LightType::spot,
          light.direction,
          light.outer_cone_rad};
}

Frame make_frame(const scene::Scene& scene, const scene::Shot& shot, int index, Vec2i viewport) {
  if (!is_finite(shot.pose))
    throw Error("", "camera", "has no finite place or rotation at " + std::to_string(shot.time_s) + " s");
  Frame frame;
  frame.index = index;
  frame.time_s = shot.time_s;
  frame.viewport = viewport;
  frame.projection = make_projection(shot.lens, viewport);
  frame.view_space = {shot.pose.eye, shot.pose.view_from_world};
  frame.lights = scene::world_lights(scene, shot.time_s);
  for (const scene::WorldLight& light : frame.lights)
    if (light.type == scene::LightType::point) ++frame.points;
  return frame;
}

LightArrays lights_in(const Frame& frame, const Space& space) {
  LightArrays out;
  out.points = frame.points;
  out.spots = static_cast<std::uint32_t>(frame.lights.size()) - frame.points;
  out.source = frame.lights;
  out.space = space;
  for (const scene::WorldLight& light : frame.lights) {
    const Vec3d center = space.rotation * (light.position - space.origin);
    out.x.push_back(static_cast<float>(center.x));
    out.y.push_back(static_cast<float>(center.y));
    out.z.push_back(static_cast<float>(center.z));
    out.radius.push_back(geom::rounded_up(light.range_m));
    out.reach.push_back(
        geom::rounded_up(std::abs(center.x) + std::abs(center.y) + std::abs(center.z) + out.radius.back()));
    if (light.type == scene::LightType::spot) add_axis(out, space.rotation, light);
  }
  return out;
}

}  // namespace clusterbench::view
