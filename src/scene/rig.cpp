#include "scene/rig.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>

#include "core/random.h"
#include "core/text.h"

namespace clusterbench::scene {
namespace {

constexpr double k_pi = 3.14159265358979323846;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

Vec3d drawn_position(SplitMix64& random, const Vec3d& lo, const Vec3d& hi) {
  const double x = random.between(lo.x, hi.x), y = random.between(lo.y, hi.y), z = random.between(lo.z, hi.z);
  return {x, y, z};
}

// Whether light i is a spot, so that `share` of the first n lights are spots, for every n.
bool is_spot(double share, int i) {
  return std::floor((i + 1.0) * share) > std::floor(i * share);
}

// Draws as many numbers for a point as for a spot, so that positions do not depend on the share of spots.
void add_light(const RigSpec& spec, int index, SplitMix64& random, Scene& scene) {
  const Vec3d half{spec.size_m.x / 2.0, 0.0, spec.size_m.z / 2.0};
  Node node;
  node.translation = drawn_position(random, -half, half + Vec3d(0.0, spec.size_m.y, 0.0));
  const Vec3d direction = drawn_position(random, Vec3d(-1.0), Vec3d(1.0));
  const double half_angle_deg = random.between(15.0, 60.0);
  Light light;
  light.name = "light " + std::to_string(index);
  light.node = index;
  light.range_given_m = spec.range_m;
  if (is_spot(spec.spots, index)) {
    node.rotation = rotation_towards(direction);
    light.type = LightType::spot;
    light.outer_cone_rad = half_angle_deg * (k_pi / 180.0);
  }
  scene.nodes.push_back(std::move(node));
  scene.lights.push_back(std::move(light));
}

void add_camera(const RigSpec& spec, Scene& scene) {
  constexpr double k_eye_height_m = 1.7;
  Node node;
  node.translation = {0.0, std::min(k_eye_height_m, spec.size_m.y / 2.0), spec.size_m.z / 2.0};
  Camera camera;
  camera.name = "look";
  camera.node = static_cast<int>(scene.nodes.size());
  camera.projection.yfov_rad = k_pi / 3.0;
  camera.projection.near_m = 0.1;
  camera.projection.far_m = camera.projection.near_m + glm::length(spec.size_m);
  scene.nodes.push_back(std::move(node));
  scene.cameras.push_back(std::move(camera));
}

// Little-endian, as in files.
void append_bytes(std::string& bytes, double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  for (int shift = 0; shift < 64; shift += 8) bytes += static_cast<char>(bits >> shift & 0xff);
}

std::string hash_of(const Scene& scene) {
  std::string bytes;
  for (const Light& light : scene.lights) {
    const Node& node = scene.nodes[static_cast<std::size_t>(light.node)];
    bytes += static_cast<char>(light.type);
    for (int axis = 0; axis < 3; ++axis) append_bytes(bytes, node.translation[axis]);
    for (int axis = 0; axis < 4; ++axis) append_bytes(bytes, node.rotation[axis]);
    append_bytes(bytes, *light.range_given_m);
    append_bytes(bytes, light.outer_cone_rad);
  }
  const Camera& camera = scene.cameras.front();
  const Vec3d& eye = scene.nodes[static_cast<std::size_t>(camera.node)].translation;
  for (const double value : {eye.x, eye.y, eye.z, camera.projection.far_m}) append_bytes(bytes, value);
  return sha256_hex(bytes);
}

}  // namespace

std::string RigSpec::name() const {
  const RigSpec defaults;
  std::string text = "rig-" + std::to_string(lights) + "-r" + number(range_m);
  if (spots != defaults.spots) text += "-s" + number(spots);
  if (size_m != defaults.size_m) text += "-" + number(size_m.x) + "x" + number(size_m.y) + "x" + number(size_m.z);
  if (seed != defaults.seed) text += "-seed" + std::to_string(seed);
  return text;
}

Scene make_rig(const RigSpec& spec) {
  Scene scene;
  scene.name = spec.name();
  scene.path = scene.name;
  scene.nodes.reserve(static_cast<std::size_t>(spec.lights) + 1);
  scene.lights.reserve(static_cast<std::size_t>(spec.lights));
  SplitMix64 random(spec.seed);
  for (int i = 0; i < spec.lights; ++i) add_light(spec, i, random, scene);
  add_camera(spec, scene);
  scene.sha256 = hash_of(scene);
  return scene;
}

}  // namespace clusterbench::scene
