#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/gltf_checked.h"

namespace clusterbench::scene {
namespace {

using nlohmann::json;

constexpr const char* k_punctual = "KHR_lights_punctual";

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

void copy_transform(const JsonLocation& node, json& out) {
  if (node.has("matrix")) {
    for (const char* other : {"translation", "rotation", "scale"}) {
      if (node.has(other)) node.at("matrix").refuse(std::string("a node has either matrix or ") + other + ", not both");
    }
    check_matrix(node.at("matrix"));
    out["matrix"] = node.at("matrix").numbers(16);
  }
  if (node.has("rotation")) {
    check_rotation(node.at("rotation"));
    out["rotation"] = node.at("rotation").numbers(4);
  }
  for (const char* key : {"translation", "scale"}) {
    if (node.has(key)) out[key] = node.at(key).numbers(3);
  }
}

void copy_light(const JsonLocation& root, const JsonLocation& node, json& out) {
  if (!node.has("extensions")) return;
  const JsonLocation extensions = node.at("extensions");
  extensions.expect_object();
  if (!extensions.has(k_punctual)) return;
  const JsonLocation reference = extensions.at(k_punctual);
  reference.expect_object();
  if (!root.has("extensions") || !root.at("extensions").has(k_punctual)) {
    reference.refuse("the document defines no lights under /extensions/KHR_lights_punctual");
  }
  const std::size_t lights = count_of(root.at("extensions").at(k_punctual), "lights");
  out["extensions"][k_punctual]["light"] = reference.at("light").index(lights, "light");
}

// Half extents of an oriented box (decal, probe), an invention of this tool: see OrientedBox.
void copy_box(const JsonLocation& node, json& out) {
  if (!node.has("extras")) return;
  warn_of_unknown_extras(node, {k_box});
  if (!node.at("extras").has(k_box)) return;
  const JsonLocation location = node.at("extras").at(k_box).at("half_extents");
  const std::vector<double> half_extents = location.numbers(3);
  if (std::any_of(half_extents.begin(), half_extents.end(), [](double h) { return h < 0.0; })) {
    location.refuse("half extents must not be negative");
  }
  out["extras"][k_box]["half_extents"] = half_extents;
}

// Inherited down the tree: whether a node is drawn, and with it its light.
void copy_visibility(const JsonLocation& node, json& out) {
  if (!node.has("extensions") || !node.at("extensions").has("KHR_node_visibility")) return;
  const JsonLocation extension = node.at("extensions").at("KHR_node_visibility");
  extension.expect_object();
  if (!extension.has("visible")) return;
  out["visible"] = extension.at("visible").boolean();
}

json checked_node(const JsonLocation& root, const JsonLocation& node, std::size_t nodes) {
  node.expect_object();
  json out = json::object();
  copy_name(node, out);
  copy_transform(node, out);
  if (node.has("camera")) out["camera"] = node.at("camera").index(count_of(root, "cameras"), "camera");
  if (node.has("children")) {
    const JsonLocation children = node.at("children");
    const std::size_t count = children.elements();
    for (std::size_t i = 0; i < count; ++i) {
      out["children"].push_back(children.at(i).index(nodes, "node"));
    }
  }
  copy_light(root, node, out);
  copy_visibility(node, out);
  copy_box(node, out);
  return out;
}

constexpr std::size_t k_none = static_cast<std::size_t>(-1);

// The parent of each node. A node with two would stand under two parents.
std::vector<std::size_t> parents_of(const JsonLocation& nodes, const json& checked,
                                    const std::vector<bool>& is_loaded) {
  std::vector<std::size_t> parent(checked.size(), k_none);
  for (std::size_t i = 0; i < checked.size(); ++i) {
    if (!checked[i].contains("children")) continue;
    const json& children = checked[i]["children"];
    for (std::size_t k = 0; k < children.size(); ++k) {
      const std::size_t child = children[k].get<std::size_t>();
      const JsonLocation location = nodes.at(i).at("children").at(k);
      const std::string fault =
          "node " + std::to_string(child) + " already has the parent " + std::to_string(parent[child]);
      if (parent[child] != k_none && is_loaded[child]) location.refuse(fault);
      if (parent[child] != k_none) location.warn(fault + "; not in the scene that is loaded");
      parent[child] = i;
    }
  }
  return parent;
}

// A node above itself stands nowhere.
void check_forest(const JsonLocation& nodes, const json& checked, const std::vector<bool>& is_loaded) {
  const std::vector<std::size_t> parent = parents_of(nodes, checked, is_loaded);
  // With at most one parent each, walking up from every node finds every loop. 1: on the way up, 2: known to end.
  std::vector<char> state(checked.size(), 0);
  std::vector<std::size_t> way;
  for (std::size_t i = 0; i < checked.size(); ++i) {
    way.clear();
    std::size_t at = i;
    for (; at != k_none && state[at] == 0; at = parent[at]) {
      state[at] = 1;
      way.push_back(at);
    }
    if (at != k_none && state[at] == 1) {
      if (is_loaded[at]) nodes.at(at).refuse("the node is its own ancestor");
      nodes.at(at).warn("the node is its own ancestor; not in the scene that is loaded");
    }
    for (const std::size_t passed : way) state[passed] = 2;
  }
}

}  // namespace

json checked_nodes(const JsonLocation& root, const LoadedScene& loaded) {
  json out = json::array();
  if (!root.has("nodes")) return out;
  const JsonLocation nodes = root.at("nodes");
  const std::size_t count = nodes.elements();
  for (std::size_t i = 0; i < count; ++i) {
    json node = json::object();
    try {
      node = checked_node(root, nodes.at(i), count);
    } catch (const Error& fault) {
      if (loaded.nodes[i]) throw;
      warn_of_unloaded(nodes.at(i), fault);
    }
    out.push_back(std::move(node));
  }
  check_forest(nodes, out, loaded.nodes);
  return out;
}

}  // namespace clusterbench::scene
