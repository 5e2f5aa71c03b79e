#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "scene/gltf_scene/gltf_checked.h"

namespace clusterbench::scene {
namespace {

void check_rotation(const JsonLocation& location) {
  const std::vector<double> q = location.numbers(4);
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (std::abs(length - 1.0) > k_unit_tolerance) {
    location.refuse("a rotation must have length 1, found " + std::to_string(length));
  }
}

// glTF allows only matrices that are translation * rotation * scale: orthogonal columns and a last row of 0 0 0 1.
void check_matrix(const JsonLocation& location) {
  const std::vector<double> m = location.numbers(16);
  constexpr double k_tolerance = 1e-3;
  const bool affine = std::abs(m[3]) < k_tolerance && std::abs(m[7]) < k_tolerance && std::abs(m[11]) < k_tolerance &&
                      std::abs(m[15] - 1.0) < k_tolerance;
  if (!affine) location.refuse("the matrix's last row must be 0 0 0 1");
  for (const auto& [a, b] : {std::pair(0, 4), std::pair(0, 8), std::pair(4, 8)}) {
    double dot = 0.0, aa = 0.0, bb = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double x = m[static_cast<std::size_t>(a) + i], y = m[static_cast<std::size_t>(b) + i];
      dot += x * y;
      aa += x * x;
      bb += y * y;
    }
    if (std::abs(dot) > k_tolerance * std::sqrt(aa) * std::sqrt(bb)) {
      location.refuse("the matrix is no translation, rotation and scale: its axes are not orthogonal");
    }
  }
}

Vec3d vector_of(const JsonLocation& location) {
  const std::vector<double> numbers = location.numbers(3);
  return {numbers[0], numbers[1], numbers[2]};
}

void read_transform(const JsonLocation& from, Node& out) {
  if (from.has("matrix")) {
    for (const char* other : {"translation", "rotation", "scale"}) {
      if (from.has(other)) from.at("matrix").refuse(std::string("a node has either matrix or ") + other + ", not both");
    }
    check_matrix(from.at("matrix"));
    const std::vector<double> numbers = from.at("matrix").numbers(16);
    Mat4d matrix(1.0);
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = numbers[static_cast<std::size_t>(i)];
    out.matrix = std::make_shared<const Mat4d>(matrix);
  }
  if (from.has("rotation")) {
    check_rotation(from.at("rotation"));
    const std::vector<double> q = from.at("rotation").numbers(4);
    out.rotation = {q[0], q[1], q[2], q[3]};
  }
  if (from.has("translation")) out.translation = vector_of(from.at("translation"));
  if (from.has("scale")) out.scale = vector_of(from.at("scale"));
}

std::int32_t light_of(const JsonLocation& root, const JsonLocation& node) {
  if (!node.has("extensions")) return -1;
  const JsonLocation extensions = node.at("extensions");
  extensions.expect_object();
  if (!extensions.has(k_punctual)) return -1;
  const JsonLocation reference = extensions.at(k_punctual);
  reference.expect_object();
  if (!root.has("extensions") || !root.at("extensions").has(k_punctual)) {
    reference.refuse("the document defines no lights under /extensions/KHR_lights_punctual");
  }
  const std::size_t lights = count_of(root.at("extensions").at(k_punctual), "lights");
  return static_cast<std::int32_t>(reference.at("light").index(lights, "light"));
}

// Half extents of an oriented box (decal, probe), an extension of this tool: see OrientedBox.
std::optional<Vec3d> box_of(const JsonLocation& node) {
  if (!node.has("extras")) return std::nullopt;
  warn_of_unknown_extras(node, {k_box});
  if (!node.at("extras").has(k_box)) return std::nullopt;
  const JsonLocation location = node.at("extras").at(k_box).at("half_extents");
  const Vec3d half_extents = vector_of(location);
  if (std::min({half_extents.x, half_extents.y, half_extents.z}) < 0.0)
    location.refuse("half extents must not be negative");
  return half_extents;
}

// Inherited down the tree: whether a node is drawn, and its light with it.
bool is_visible(const JsonLocation& node) {
  if (!node.has("extensions") || !node.at("extensions").has("KHR_node_visibility")) return true;
  const JsonLocation extension = node.at("extensions").at("KHR_node_visibility");
  extension.expect_object();
  return !extension.has("visible") || extension.at("visible").boolean();
}

constexpr std::uint32_t k_none = static_cast<std::uint32_t>(-1);

// The parent of each node. A node may not have two parents.
std::vector<std::uint32_t> parents_of(const JsonLocation& nodes, const NodeTable& checked,
                                      const std::vector<bool>& is_loaded) {
  std::vector<std::uint32_t> parent(checked.size(), k_none);
  for (std::size_t i = 0; i < checked.size(); ++i) {
    const std::span<const std::uint32_t> children = checked.children_of(i);
    for (std::size_t k = 0; k < children.size(); ++k) {
      const std::uint32_t child = children[k];
      if (parent[child] != k_none) {
        const JsonLocation location = nodes.at(i).at("children").at(k);
        const std::string fault =
            "node " + std::to_string(child) + " already has the parent " + std::to_string(parent[child]);
        if (is_loaded[child]) location.refuse(fault);
        location.warn(fault + "; not in the scene that is loaded");
      }
      parent[child] = static_cast<std::uint32_t>(i);
    }
  }
  return parent;
}

// A node may not be its own ancestor.
void check_forest(const JsonLocation& nodes, const NodeTable& checked, const std::vector<bool>& is_loaded) {
  const std::vector<std::uint32_t> parent = parents_of(nodes, checked, is_loaded);
  // With at most one parent each, walking up from every node finds every loop. 1: on the way up, 2: known to end.
  std::vector<char> state(checked.size(), 0);
  std::vector<std::uint32_t> way;
  for (std::size_t i = 0; i < checked.size(); ++i) {
    way.clear();
    auto at = static_cast<std::uint32_t>(i);
    for (; at != k_none && state[at] == 0; at = parent[at]) {
      state[at] = 1;
      way.push_back(at);
    }
    if (at != k_none && state[at] == 1) {
      if (is_loaded[at]) nodes.at(at).refuse("the node is its own ancestor");
      nodes.at(at).warn("the node is its own ancestor; not in the scene that is loaded");
    }
    for (const std::uint32_t passed : way) state[passed] = 2;
  }
}

}  // namespace

ReadNode read_node(const JsonLocation& root, const JsonLocation& from, std::size_t nodes) {
  from.expect_object();
  ReadNode out;
  out.node.name = name_of(from);
  read_transform(from, out.node);
  if (from.has("camera"))
    out.camera = static_cast<std::int32_t>(from.at("camera").index(count_of(root, "cameras"), "camera"));
  if (from.has("children")) {
    const JsonLocation children = from.at("children");
    const std::size_t count = children.elements();
    for (std::size_t i = 0; i < count; ++i)
      out.children.push_back(static_cast<std::uint32_t>(children.at(i).index(nodes, "node")));
  }
  out.light = light_of(root, from);
  out.node.visible = is_visible(from);
  out.box_half_extents_m = box_of(from);
  return out;
}

NodeTable checked_nodes(const JsonLocation& root, const LoadedScene& loaded) {
  NodeTable out;
  out.first_child.push_back(0);
  if (!root.has("nodes")) return out;
  const JsonLocation nodes = root.at("nodes");
  const std::size_t count = nodes.elements();
  if (count >= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) nodes.refuse("more than 2^31 nodes");
  out.light.reserve(count);
  out.camera.reserve(count);
  out.first_child.reserve(count + 1);
  for (std::size_t i = 0; i < count; ++i) {
    ReadNode read;
    bool has_transform = false;
    try {
      const JsonLocation node = nodes.at(i);
      read = read_node(root, node, count);
      has_transform = node.has("matrix") || node.has("translation") || node.has("rotation") || node.has("scale");
    } catch (const Error& fault) {
      if (loaded.nodes[i]) throw;
      warn_of_unloaded(nodes.at(i), fault);
      read = {};
    }
    out.light.push_back(read.light);
    out.camera.push_back(read.camera);
    out.has_transform.push_back(has_transform);
    out.children.insert(out.children.end(), read.children.begin(), read.children.end());
    out.first_child.push_back(static_cast<std::uint32_t>(out.children.size()));
  }
  check_forest(nodes, out, loaded.nodes);
  return out;
}

}  // namespace clusterbench::scene
