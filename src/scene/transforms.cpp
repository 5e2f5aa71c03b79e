// Where nodes, lights and cameras stand at a time.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "scene/animation.h"
#include "scene/scene.h"

namespace clusterbench::scene {
namespace {

// Unit vector along v, or `otherwise` if v has no direction. Divides by the largest component first, so that neither
// huge nor tiny vectors overflow or vanish.
Vec3d unit_or(const Vec3d& v, const Vec3d& otherwise) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest > 0.0) || !std::isfinite(largest)) return otherwise;
  return glm::normalize(v / largest);
}

Mat3d rotation_matrix(const Vec4d& q) {
  const double norm = glm::dot(q, q);
  const double s = norm > 0.0 ? 2.0 / norm : 0.0;
  const double x = q.x, y = q.y, z = q.z, w = q.w;
  return Mat3d(1.0 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y),   // first column
               s * (x * y - w * z), 1.0 - s * (x * x + z * z), s * (y * z + w * x),   // second column
               s * (x * z + w * y), s * (y * z - w * x), 1.0 - s * (x * x + y * y));  // third column
}

Mat4d local_matrix(const Node& node) {
  if (node.has_matrix) return node.matrix;
  const Mat3d rotation = rotation_matrix(node.rotation);
  return Mat4d(Vec4d(rotation[0] * node.scale.x, 0.0), Vec4d(rotation[1] * node.scale.y, 0.0),
               Vec4d(rotation[2] * node.scale.z, 0.0), Vec4d(node.translation, 1.0));
}

void apply(const Channel& channel, double time_s, Node& node) {
  const Vec4d value = sample(channel, time_s);
  switch (channel.path) {
    case ChannelPath::translation:
      node.translation = Vec3d(value);
      break;
    case ChannelPath::rotation:
      node.rotation = value;
      break;
    case ChannelPath::scale:
      node.scale = Vec3d(value);
      break;
  }
}

WorldLight world_light(const Light& light, int rig_index, const Mat4d& world) {
  WorldLight out;
  out.rig_index = rig_index;
  out.type = light.type;
  out.position = Vec3d(world[3]);
  out.range_m = light.range_m;
  // A node scaled to nothing has no direction; it keeps glTF's own -Z.
  out.direction = unit_or(-Vec3d(world[2]), Vec3d(0.0, 0.0, -1.0));
  out.outer_cone_rad = light.type == LightType::spot ? light.outer_cone_rad : 0.0;
  return out;
}

// A unit vector orthogonal to the unit vector `back`, as near to `up` as can be.
Vec3d up_orthogonal_to(const Vec3d& back, const Vec3d& up) {
  const Vec3d hint = unit_or(up, Vec3d(0.0));
  const Vec3d across = hint - back * glm::dot(hint, back);
  constexpr double k_parallel = 1e-12;
  if (glm::length(across) > k_parallel) {
    const Vec3d once = glm::normalize(across);
    return glm::normalize(once -
                          back * glm::dot(once, back));  // again: the first pass loses digits when nearly parallel
  }
  const Vec3d axis = std::abs(back.y) < 0.9 ? Vec3d(0.0, 1.0, 0.0) : Vec3d(1.0, 0.0, 0.0);
  return glm::normalize(axis - back * glm::dot(axis, back));
}

// World transform of one node: what world_transforms() says, from the nodes above it alone.
Mat4d world_transform(const Scene& scene, int index, double time_s) {
  std::vector<int> chain;
  for (; index >= 0; index = scene.nodes[static_cast<std::size_t>(index)].parent) chain.push_back(index);
  std::reverse(chain.begin(), chain.end());  // parents come first, so it ascends
  std::vector<Node> posed;
  for (const int node : chain) posed.push_back(scene.nodes[static_cast<std::size_t>(node)]);
  for (const Channel& channel : scene.channels) {
    const auto place = std::lower_bound(chain.begin(), chain.end(), channel.node);
    if (place != chain.end() && *place == channel.node)
      apply(channel, time_s, posed[static_cast<std::size_t>(place - chain.begin())]);
  }
  Mat4d world = local_matrix(posed.front());
  for (std::size_t i = 1; i < posed.size(); ++i) world = world * local_matrix(posed[i]);
  return world;
}

}  // namespace

std::vector<Mat4d> world_transforms(const Scene& scene, double time_s) {
  std::vector<Node> posed = scene.nodes;
  for (const Channel& channel : scene.channels) {
    apply(channel, time_s, posed[static_cast<std::size_t>(channel.node)]);
  }
  std::vector<Mat4d> world;
  world.reserve(posed.size());
  for (const Node& node : posed) {
    const Mat4d local = local_matrix(node);
    world.push_back(node.parent < 0 ? local : world[static_cast<std::size_t>(node.parent)] * local);
  }
  return world;
}

std::vector<WorldLight> world_lights(const Scene& scene, double time_s) {
  const std::vector<Mat4d> world = world_transforms(scene, time_s);
  std::vector<WorldLight> out;
  for (const LightType type : {LightType::point, LightType::spot}) {
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
      const Light& light = scene.lights[i];
      if (light.type != type) continue;
      out.push_back(world_light(light, static_cast<int>(i), world[static_cast<std::size_t>(light.node)]));
    }
  }
  return out;
}

// The camera looks along the world matrix's -Z; up is its Y made orthogonal to that (Gram-Schmidt); right follows from
// the two as a right-handed frame, so X is not looked at and a mirrored node shows no mirrored picture.
CameraPose camera_pose(const Scene& scene, const Camera& camera, double time_s) {
  const Mat4d world = world_transform(scene, camera.node, time_s);
  const Vec3d back = unit_or(Vec3d(world[2]), Vec3d(0.0, 0.0, 1.0));
  const Vec3d up = up_orthogonal_to(back, Vec3d(world[1]));
  const Vec3d right = glm::cross(up, back);
  CameraPose pose;
  pose.eye = Vec3d(world[3]);
  pose.view_from_world = Mat3d(right.x, up.x, back.x,  // columns; the rows are right, up, back
                               right.y, up.y, back.y, right.z, up.z, back.z);
  return pose;
}

Vec4d rotation_towards(const Vec3d& direction) {
  const Vec3d d = glm::normalize(direction);
  if (d.z > 0.999999) return {0.0, 1.0, 0.0, 0.0};
  const Vec4d q{d.y, -d.x, 0.0, 1.0 - d.z};
  return q / std::sqrt(glm::dot(q, q));
}

}  // namespace clusterbench::scene
