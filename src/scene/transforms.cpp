// Poses of nodes, lights and cameras at a time.

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <span>

#include "core/error.h"
#include "core/text.h"
#include "geom/shapes/domain.h"
#include "scene/animation.h"
#include "scene/scene.h"
#include "scene/world_check.h"

namespace clusterbench::scene {
namespace {

// The number that means "no end" in files.
constexpr double k_endless = std::numeric_limits<float>::max();

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

// The animated part of a node, without its name: each moment copies it for every node, possibly a million.
struct NodePose {
  NodePose() = default;
  explicit NodePose(const Node& node)
      : parent(node.parent),
        visible(node.visible),
        matrix(node.matrix.get()),
        translation(node.translation),
        rotation(node.rotation),
        scale(node.scale) {}

  int parent = -1;
  bool visible = true;
  const Mat4d* matrix = nullptr;  // in place of the three below
  Vec3d translation{0.0};
  Vec4d rotation{0.0};
  Vec3d scale{1.0};
};

Mat4d local_matrix(const NodePose& node) {
  if (node.matrix) return *node.matrix;
  const Mat3d rotation = rotation_matrix(node.rotation);
  return Mat4d(Vec4d(rotation[0] * node.scale.x, 0.0), Vec4d(rotation[1] * node.scale.y, 0.0),
               Vec4d(rotation[2] * node.scale.z, 0.0), Vec4d(node.translation, 1.0));
}

void apply(const Channel& channel, double time_s, NodePose& node) {
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
    case ChannelPath::visible:
      node.visible = value.x != 0.0;
      break;
    default:
      assert(false);  // the other paths belong to lights
  }
}

// For linear Rec. 709 primaries, the colour space of glTF.
double luminance(const Vec3d& color) {
  return 0.2126 * color.x + 0.7152 * color.y + 0.0722 * color.z;
}

// A spline may swing below 0 between its keys, and an angle beyond a half-space.
void apply(const Channel& channel, double time_s, Light& light) {
  const Vec3d value = glm::max(Vec3d(sample(channel, time_s)), Vec3d(0.0));
  constexpr double k_widest = 1.57079632679489661923;
  switch (channel.path) {
    case ChannelPath::range:
      light.range_given_m = value.x;
      break;
    case ChannelPath::intensity:
      light.intensity = value.x;
      break;
    case ChannelPath::color:
      light.color = value;
      break;
    case ChannelPath::inner_cone:
      light.inner_cone_rad = std::min(value.x, k_widest);
      break;
    case ChannelPath::outer_cone:
      light.outer_cone_rad = std::min(value.x, k_widest);
      break;
    default:
      assert(false);  // the other paths belong to nodes
  }
}

struct ByDefinition {
  bool operator()(const Channel& channel, int definition) const { return channel.definition < definition; }
  bool operator()(int definition, const Channel& channel) const { return definition < channel.definition; }
};

std::span<const Channel> channels_of(const std::vector<Channel>& channels, int definition) {
  const auto [first, last] = std::equal_range(channels.begin(), channels.end(), definition, ByDefinition{});
  return {first, last};
}

void apply(const Channel& channel, double time_s, CameraProjection& projection) {
  const double value = sample(channel, time_s).x;
  switch (channel.path) {
    case ChannelPath::yfov:
      projection.yfov_rad = value;
      break;
    case ChannelPath::aspect_ratio:
      projection.aspect_ratio = value;
      break;
    case ChannelPath::near:
      projection.near_m = value;
      break;
    case ChannelPath::far:
      projection.far_m = value >= k_endless ? std::numeric_limits<double>::infinity() : value;
      break;
    case ChannelPath::xmag:
      projection.xmag_m = std::abs(value);
      break;
    case ChannelPath::ymag:
      projection.ymag_m = std::abs(value);
      break;
    default:
      assert(false);  // the other paths belong to nodes and lights
  }
}

// The same condition as the loader's for a static projection.
bool shows_something(const CameraProjection& projection) {
  constexpr double k_half_turn = 3.14159265358979323846;
  if (!(projection.far_m > projection.near_m)) return false;
  if (projection.orthographic) return projection.near_m >= 0.0 && projection.xmag_m > 0.0 && projection.ymag_m > 0.0;
  return projection.near_m > 0.0 && projection.yfov_rad > 0.0 && projection.yfov_rad < k_half_turn &&
         projection.aspect_ratio.value_or(1.0) > 0.0;
}

// The light with its channels applied, at a time.
Light light_at(const Scene& scene, const Light& light, std::span<const Channel> channels, double time_s) {
  Light out = light;
  for (const Channel& channel : channels) apply(channel, time_s, out);
  if (out.range_given_m && *out.range_given_m >= k_endless) out.range_given_m.reset();
  resolve_range(out, scene.range_rule);
  out.inner_cone_rad = std::min(out.inner_cone_rad, out.outer_cone_rad);
  if (out.type == LightType::spot && out.outer_cone_rad == 0.0) out.range_m = 0.0;  // closed
  return out;
}

// A box without any extent has no volume, like a light without a range.
void set_box(WorldLight& out, const Vec3d& half_extents_m, const Mat4d& world) {
  for (int axis = 0; axis < 3; ++axis)
    out.half_axes_m[static_cast<std::size_t>(axis)] = half_extents_m[axis] * Vec3d(world[axis]);
  out.range_m = geom::range_in_domain(corner_distance_m(out.half_axes_m));
}

bool is_flat(const NodePose& node) {
  return !node.matrix && (node.scale.x == 0.0 || node.scale.y == 0.0 || node.scale.z == 0.0);
}

// Axes of a node below one that is scaled to zero, with ones in place of the zeros: lights and cameras keep their
// direction for any scale of their nodes, and exporters hide objects by a scale of 0. `node_of(index)`: as posed.
template <class NodeOf>
Mat3d unflattened_axes(int index, const NodeOf& node_of) {
  Mat3d axes(1.0);
  while (index >= 0) {
    NodePose node = node_of(index);
    for (int axis = 0; axis < 3; ++axis)
      if (node.scale[axis] == 0.0) node.scale[axis] = 1.0;
    axes = Mat3d(local_matrix(node)) * axes;
    index = node.parent;
  }
  return axes;
}

void set_axes(Mat4d& world, const Mat3d& axes) {
  for (int axis = 0; axis < 3; ++axis) world[axis] = Vec4d(axes[axis], 0.0);
}

// `back`: the world direction of the node's z axis.
WorldLight world_light(const Light& light, int rig_index, const Mat4d& world, const Vec3d& back) {
  WorldLight out;
  out.rig_index = rig_index;
  out.type = light.type;
  out.position = Vec3d(world[3]);
  out.range_m = geom::range_in_domain(light.range_m);
  // A matrix of zeros has no direction; it keeps glTF's own -Z.
  out.direction = unit_or(-back, Vec3d(0.0, 0.0, -1.0));
  if (light.type == LightType::spot) {
    out.outer_cone_rad = light.outer_cone_rad;
    out.inner_cone_rad = light.inner_cone_rad;
  }
  out.luminous_intensity_cd = light.intensity * luminance(light.color);
  if (light.type == LightType::box) set_box(out, light.half_extents_m, world);
  return out;
}

// A unit vector orthogonal to the unit vector `back`, as close to `up` as possible.
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

// World transform of a camera's node: as in world_transforms(), but computed from the nodes above it only, and with
// flattened axes restored.
Mat4d camera_transform(const Scene& scene, int index, double time_s) {
  std::vector<int> chain;
  for (; index >= 0; index = scene.nodes[static_cast<std::size_t>(index)].parent) chain.push_back(index);
  std::reverse(chain.begin(), chain.end());  // parents come first, so it ascends
  std::vector<NodePose> posed;
  for (const int node : chain) posed.emplace_back(scene.nodes[static_cast<std::size_t>(node)]);
  for (const Channel& channel : scene.channels) {
    const auto link = std::lower_bound(chain.begin(), chain.end(), channel.node);
    if (link != chain.end() && *link == channel.node)
      apply(channel, time_s, posed[static_cast<std::size_t>(link - chain.begin())]);
  }
  Mat4d world = local_matrix(posed.front());
  for (std::size_t i = 1; i < posed.size(); ++i) world = world * local_matrix(posed[i]);
  if (std::ranges::any_of(posed, is_flat)) {
    const auto node_of = [&](int node) -> const NodePose& {
      return posed[static_cast<std::size_t>(std::ranges::lower_bound(chain, node) - chain.begin())];
    };
    set_axes(world, unflattened_axes(chain.back(), node_of));
  }
  return world;
}

// Poses of all nodes at a time; those of a static scene are not copied.
class Poses {
 public:
  explicit Poses(const Scene& scene) : nodes_(scene.nodes) {}  // at rest
  Poses(const Scene& scene, double time_s) : nodes_(scene.nodes) {
    if (scene.channels.empty()) return;
    moved_.reserve(nodes_.size());
    for (const Node& node : nodes_) moved_.emplace_back(node);
    for (const Channel& channel : scene.channels)
      apply(channel, time_s, moved_[static_cast<std::size_t>(channel.node)]);
  }

  std::size_t size() const { return nodes_.size(); }
  NodePose operator[](std::size_t node) const { return moved_.empty() ? NodePose(nodes_[node]) : moved_[node]; }

 private:
  const std::vector<Node>& nodes_;
  std::vector<NodePose> moved_;
};

std::vector<Mat4d> transforms_of(const Poses& posed) {
  std::vector<Mat4d> world;
  world.reserve(posed.size());
  for (std::size_t i = 0; i < posed.size(); ++i) {
    const NodePose node = posed[i];
    const Mat4d local = local_matrix(node);
    world.push_back(node.parent < 0 ? local : world[static_cast<std::size_t>(node.parent)] * local);
  }
  return world;
}

// World transforms; kept only for nodes with children: with a million lamps these are few.
class NodeTransforms {
 public:
  explicit NodeTransforms(const Poses& posed) : posed_(posed), kept_at_(posed.size(), -1) {
    std::vector<bool> is_parent(posed.size(), false);
    for (std::size_t i = 0; i < posed.size(); ++i) {
      const NodePose node = posed[i];
      if (node.parent >= 0) is_parent[static_cast<std::size_t>(node.parent)] = true;
      has_flat_ = has_flat_ || is_flat(node);
    }
    for (std::size_t i = 0; i < posed.size(); ++i) {
      if (!is_parent[i]) continue;
      const Mat4d world = of(i);
      kept_at_[i] = static_cast<std::int32_t>(kept_.size());
      kept_.push_back(world);
    }
  }

  // The direction of its z axis.
  Vec3d back_of(std::size_t node, const Mat4d& world) const {
    if (!has_flat_ || !is_in_flat_chain(node)) return Vec3d(world[2]);
    const auto node_of = [&](int index) { return posed_[static_cast<std::size_t>(index)]; };
    return unflattened_axes(static_cast<int>(node), node_of)[2];
  }
  Mat4d of(std::size_t node) const {
    const NodePose pose = posed_[node];
    const Mat4d local = local_matrix(pose);
    if (pose.parent < 0) return local;
    return kept_[static_cast<std::size_t>(kept_at_[static_cast<std::size_t>(pose.parent)])] * local;
  }

 private:
  // Only then: a node elsewhere that is hidden by a scale of 0 changes no bit of this one's lights.
  bool is_in_flat_chain(std::size_t node) const {
    for (int index = static_cast<int>(node); index >= 0; index = posed_[static_cast<std::size_t>(index)].parent)
      if (is_flat(posed_[static_cast<std::size_t>(index)])) return true;
    return false;
  }

  const Poses& posed_;
  std::vector<std::int32_t> kept_at_;
  std::vector<Mat4d> kept_;
  bool has_flat_ = false;
};

std::vector<bool> visible_of(const Poses& posed) {
  std::vector<bool> visible;
  visible.reserve(posed.size());
  for (std::size_t i = 0; i < posed.size(); ++i) {
    const NodePose node = posed[i];
    visible.push_back(node.visible && (node.parent < 0 || visible[static_cast<std::size_t>(node.parent)]));
  }
  return visible;
}

}  // namespace

std::vector<Mat4d> world_transforms(const Scene& scene, double time_s) {
  return transforms_of(Poses(scene, time_s));
}

std::vector<Mat4d> rest_transforms(const Scene& scene) {
  return transforms_of(Poses(scene));
}

std::optional<std::size_t> first_node_without_place(const Scene& scene) {
  const Poses posed(scene, 0.0);
  const NodeTransforms world(posed);
  for (std::size_t i = 0; i < posed.size(); ++i) {
    const Mat4d transform = world.of(i);
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 4; ++row)
        if (!std::isfinite(transform[column][row])) return i;
  }
  return std::nullopt;
}

std::vector<bool> visible_nodes(const Scene& scene, double time_s) {
  return visible_of(Poses(scene, time_s));
}

std::vector<WorldLight> world_lights(const Scene& scene, double time_s) {
  const Poses posed(scene, time_s);
  const NodeTransforms world(posed);
  const std::vector<bool> visible = visible_of(posed);
  std::vector<WorldLight> out;
  out.reserve(scene.lights.size());
  for (const LightType type : {LightType::point, LightType::spot, LightType::box}) {
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
      const Light& light = scene.lights[i];
      if (light.type != type) continue;
      const auto node = static_cast<std::size_t>(light.node);
      const auto channels = channels_of(scene.light_channels, light.definition);
      const Mat4d transform = world.of(node);
      const std::optional<Light> changed =
          channels.empty() ? std::nullopt : std::optional(light_at(scene, light, channels, time_s));
      out.push_back(
          world_light(changed ? *changed : light, static_cast<int>(i), transform, world.back_of(node, transform)));
      if (!visible[node]) out.back().range_m = 0.0;
    }
  }
  return out;
}

// The camera looks along the world matrix's -Z; up is its Y made orthogonal to that (Gram-Schmidt); right completes a
// right-handed frame. So X is ignored, and a mirrored node shows no mirrored picture.
CameraPose camera_pose(const Mat4d& world) {
  const Vec3d back = unit_or(Vec3d(world[2]), Vec3d(0.0, 0.0, 1.0));
  const Vec3d up = up_orthogonal_to(back, Vec3d(world[1]));
  const Vec3d right = glm::cross(up, back);
  CameraPose pose;
  pose.eye = Vec3d(world[3]);
  pose.view_from_world = Mat3d(right.x, up.x, back.x,  // columns; the rows are right, up, back
                               right.y, up.y, back.y, right.z, up.z, back.z);
  return pose;
}

CameraPose camera_pose(const Scene& scene, const Camera& camera, double time_s) {
  return camera_pose(camera_transform(scene, camera.node, time_s));
}

CameraProjection projection_at(const Scene& scene, const Camera& camera, double time_s) {
  const auto channels = channels_of(scene.camera_channels, camera.definition);
  CameraProjection projection = camera.projection;
  for (const Channel& channel : channels) apply(channel, time_s, projection);
  if (!channels.empty() && !shows_something(projection))
    throw Error(scene.path.string(), "camera '" + printable(camera.name) + "'",
                "shows nothing at " + std::to_string(time_s) +
                    " s: its angle and size must be more than 0, its angle less than pi, its zfar beyond its znear");
  return projection;
}

Vec4d rotation_towards(const Vec3d& direction) {
  const Vec3d d = glm::normalize(direction);
  if (d.z > 0.999999) return {0.0, 1.0, 0.0, 0.0};
  const Vec4d q{d.y, -d.x, 0.0, 1.0 - d.z};
  return q / std::sqrt(glm::dot(q, q));
}

}  // namespace clusterbench::scene
