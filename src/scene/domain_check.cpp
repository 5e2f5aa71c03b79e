#include "scene/domain_check.h"

#include <cmath>
#include <cstdio>

#include "core/error.h"
#include "core/work_in_order.h"
#include "geom/shapes/domain.h"
#include "scene/digests.h"

namespace clusterbench::scene {
namespace {

std::string nine_digits(double value) {
  if (std::isnan(value)) return "nan";  // without its sign
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

std::string position_text(const Vec3d& p) {
  return "(" + nine_digits(p.x) + ", " + nine_digits(p.y) + ", " + nine_digits(p.z) + ") m";
}

bool is_in_domain(const Vec3d& p) {
  return geom::is_in_domain(p.x) && geom::is_in_domain(p.y) && geom::is_in_domain(p.z);
}

// The node's place in the file; "" if it has none.
std::string node_location(const Scene& scene, int index) {
  const bool is_known = index >= 0 && static_cast<std::size_t>(index) < scene.nodes.size();
  const int node = is_known ? scene.nodes[static_cast<std::size_t>(index)].gltf_index : -1;
  return node < 0 ? "" : "/nodes/" + std::to_string(node);
}

std::string camera_location(const Scene& scene, const std::string& name) {
  for (const Camera& camera : scene.cameras)
    if (camera.name == name) return node_location(scene, camera.node);
  return "";
}

[[noreturn]] void refuse(const Scene& scene, const std::string& where, const std::string& problem, double time_s) {
  throw Error(scene.path.string(), where, problem + " at " + nine_digits(time_s) + " s");
}

}  // namespace

void check_domain(const Scene& scene, std::span<const WorldLight> lights, double time_s) {
  for (const WorldLight& light : lights) {
    const bool has_position = is_in_domain(light.position), has_range = light.range_m >= 0.0;
    const bool is_endless_box = light.type == LightType::box && !std::isfinite(light.range_m);
    if (has_position && has_range && !is_endless_box) continue;
    const Light& source = scene.lights.at(static_cast<std::size_t>(light.rig_index));
    if (has_position && light.type == LightType::box)
      refuse(scene, node_location(scene, source.node),
             "the box '" + source.name + "' reaches farther from its middle than " + nine_digits(geom::k_farthest_m) +
                 " m",
             time_s);
    const std::string subject = "the light '" + source.name + "' ";
    if (!has_position)
      refuse(scene, node_location(scene, source.node),
             subject + "stands at " + position_text(light.position) + ", farther from the origin than " +
                 nine_digits(geom::k_farthest_m) + " m along an axis",
             time_s);
    refuse(scene, node_location(scene, source.node),
           subject + "has a range of " + nine_digits(light.range_m) + " m, and 0 or more is allowed", time_s);
  }
}

void check_domain(const Scene& scene, const std::string& camera, const Shot& shot) {
  const auto fail = [&](const std::string& problem) {
    refuse(scene, camera_location(scene, camera), "the camera " + (camera.empty() ? "" : "'" + camera + "' ") + problem,
           shot.time_s);
  };
  if (!is_in_domain(shot.pose.eye))
    fail("stands at " + position_text(shot.pose.eye) + ", farther from the origin than " +
         nine_digits(geom::k_farthest_m) + " m along an axis");
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      if (!(std::abs(shot.pose.view_from_world[column][row]) <= 2.0)) fail("has no rotation");
}

void check_domain(const Scene& scene, const CameraPath& path, int threads) {
  const bool change = lights_change(scene);
  constexpr int k_shots_at_once = 8;
  ranges_in_order(threads, static_cast<int>(path.shots.size()), k_shots_at_once, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const Shot& shot = path.shots[static_cast<std::size_t>(i)];
      check_domain(scene, path.camera, shot);
      if (i == 0 || change) check_domain(scene, world_lights(scene, shot.time_s), shot.time_s);
    }
  });
}

}  // namespace clusterbench::scene
