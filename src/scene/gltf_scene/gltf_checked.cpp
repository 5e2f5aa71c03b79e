#include "scene/gltf_scene/gltf_checked.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>

#include "core/text.h"

namespace clusterbench::scene {
namespace {

// "major.minor" as two numbers.
std::pair<long, long> version_of(const JsonLocation& location) {
  const std::string& text = location.text();
  const std::size_t dot = text.find('.');
  const auto digits = [](std::string_view part) {
    return !part.empty() && part.size() <= 9 &&
           std::all_of(part.begin(), part.end(), [](char c) { return c >= '0' && c <= '9'; });
  };
  if (dot == std::string::npos || !digits(std::string_view(text).substr(0, dot)) ||
      !digits(std::string_view(text).substr(dot + 1))) {
    location.refuse("found '" + text.substr(0, 40) + "', a version such as 2.0 is needed");
  }
  return {std::stol(text.substr(0, dot)), std::stol(text.substr(dot + 1))};
}

void check_asset(const JsonLocation& root) {
  if (!root.has("asset")) root.refuse("is JSON, but no glTF, which has an object 'asset'");
  const JsonLocation asset = root.at("asset");
  const auto version = version_of(asset.at("version"));
  if (version.first != 2) {
    asset.at("version").refuse("glTF " + asset.at("version").text() + " found, glTF 2.x is needed");
  }
  if (version.second != 0) asset.at("version").warn("read as glTF 2.0");
  if (!asset.has("minVersion")) return;
  const JsonLocation min_version = asset.at("minVersion");
  const auto least = version_of(min_version);
  if (least > version) min_version.refuse("greater than the asset's version");
}

// Extensions that a file may require: this tool reads them, or they concern meshes, textures or materials. Pointers of
// KHR_animation_pointer are checked one by one (gltf_checked_animations.cpp).
bool changes_no_light(const std::string& name) {
  constexpr std::array k_harmless = {"KHR_draco_mesh_compression",
                                     "KHR_lights_punctual",
                                     "KHR_mesh_",
                                     "KHR_texture_",
                                     "KHR_materials_",
                                     "KHR_xmp",
                                     "EXT_texture_",
                                     "EXT_mesh_features",
                                     "EXT_meshopt_",
                                     "EXT_structural_metadata",
                                     "MSFT_texture_",
                                     "KHR_node_visibility",
                                     k_pointers};
  return std::any_of(k_harmless.begin(), k_harmless.end(),
                     [&](const char* prefix) { return name.starts_with(prefix); });
}

void check_extensions(const JsonLocation& root) {
  if (!root.has("extensionsRequired")) return;
  const JsonLocation required = root.at("extensionsRequired");
  const std::size_t count = required.elements();
  for (std::size_t i = 0; i < count; ++i) {
    const std::string name = required.at(i).text();
    if (name == "EXT_mesh_gpu_instancing") {
      required.at(i).warn("EXT_mesh_gpu_instancing multiplies meshes only, never lights");
    } else if (!changes_no_light(name)) {
      required.at(i).warn("the extension '" + name + "' is not known and ignored");
    }
  }
}

constexpr std::uint32_t k_no_parent = static_cast<std::uint32_t>(-1);

// A root has no parent. A root outside the loaded scene moves nothing.
void check_root(const JsonLocation& root, std::size_t node, std::uint32_t parent, const NodeTable& nodes,
                const LoadedScene& loaded) {
  if (parent == k_no_parent) return;
  if (loaded.nodes[parent])
    root.refuse("node " + std::to_string(node) + " has a parent that is loaded; a scene lists roots");
  root.warn("node " + std::to_string(node) + " has the parent " + std::to_string(parent) +
            ", which does not stand in the scene; read as a root" +
            (nodes.has_transform[parent] ? ", without that parent's transform" : ""));
}

std::vector<std::uint32_t> checked_roots(const JsonLocation& scene, const NodeTable& nodes,
                                         const std::vector<std::uint32_t>& parents, const LoadedScene& loaded) {
  scene.expect_object();
  std::vector<std::uint32_t> roots;
  if (!scene.has("nodes")) return roots;
  const JsonLocation list = scene.at("nodes");
  const std::size_t count = list.elements();
  std::vector<bool> is_listed(parents.size(), false);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t node = list.at(k).index(parents.size(), "node");
    check_root(list.at(k), node, parents[node], nodes, loaded);
    if (is_listed[node]) list.at(k).refuse("node " + std::to_string(node) + " is listed twice");
    is_listed[node] = true;
    roots.push_back(static_cast<std::uint32_t>(node));
  }
  return roots;
}

// The roots of the loaded scene; without scenes, all nodes that have no parent.
std::vector<std::uint32_t> checked_scenes(const JsonLocation& root, const LoadedScene& loaded, const NodeTable& nodes) {
  std::vector<std::uint32_t> parents(nodes.size(), k_no_parent), roots;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const std::uint32_t child : nodes.children_of(i)) parents[child] = static_cast<std::uint32_t>(i);
  const std::size_t count = root.has("scenes") ? root.at("scenes").elements() : 0;
  for (std::size_t i = 0; i < count; ++i) {
    const JsonLocation scene = root.at("scenes").at(i);
    try {
      std::vector<std::uint32_t> found = checked_roots(scene, nodes, parents, loaded);
      if (i == loaded.scene) roots = std::move(found);
    } catch (const Error& fault) {
      if (i == loaded.scene) throw;
      warn_of_unloaded(scene, fault);
    }
  }
  for (std::size_t i = 0; count == 0 && i < nodes.size(); ++i)
    if (parents[i] == k_no_parent) roots.push_back(static_cast<std::uint32_t>(i));
  return roots;
}

}  // namespace

std::size_t count_of(const JsonLocation& root, const std::string& key) {
  if (!root.has(key)) return 0;
  root.at(key).expect_array();
  return root.at(key).size();
}

void warn_of_unloaded(const JsonLocation& location, const Error& fault) {
  location.warn(fault.where() + ": " + fault.message() + "; not in the scene that is loaded, so left out");
}

bool is_required(const JsonLocation& root, const std::string& extension) {
  const std::size_t count = count_of(root, "extensionsRequired");
  for (std::size_t i = 0; i < count; ++i) {
    if (root.at("extensionsRequired").at(i).text() == extension) return true;
  }
  return false;
}

void warn_of_unknown_extras(const JsonLocation& object, const std::vector<std::string>& own) {
  constexpr std::string_view k_tool = "clusterbench";
  if (!object.has("extras") || !object.at("extras").value().is_object()) return;
  for (const auto& [key, value] : object.at("extras").value().items()) {
    std::string letters;  // in any case, with or without dashes
    for (const char c : key)
      if (std::isalpha(static_cast<unsigned char>(c)) != 0)
        letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const bool is_own = std::find(own.begin(), own.end(), key) != own.end();
    // "clusterbnch_box" is close enough to be a misspelling, too.
    const std::vector<std::string> all{k_box, k_sides};
    if (is_own || (!letters.starts_with(k_tool) && nearest_name(key, all).empty())) continue;
    const bool is_elsewhere = std::find(all.begin(), all.end(), key) != all.end();
    object.at("extras").at(key).warn("is not read" + (is_elsewhere ? "" : did_you_mean(key, all)) +
                                     "; nodes can have " + k_box + ", cameras " + k_sides);
  }
}

std::string name_of(const JsonLocation& object) {
  if (!object.has("name")) return "";
  const JsonLocation name = object.at("name");
  if (!name.value().is_null()) return name.text();
  name.warn("null, where glTF asks for a string; read as no name");
  return "";
}

CheckedDocument checked_document(const JsonLocation& root, const LoadedScene& loaded,
                                 std::optional<std::size_t> animation) {
  root.expect_object();
  check_asset(root);
  check_extensions(root);
  CheckedDocument out;
  out.nodes = checked_nodes(root, loaded);
  out.roots = checked_scenes(root, loaded, out.nodes);
  if (root.has("scene")) root.at("scene").index(count_of(root, "scenes"), "scene");
  out.cameras = checked_cameras(root);
  out.lights = checked_lights(root);
  out.animations = checked_animations(root, loaded, out, animation);
  return out;
}

}  // namespace clusterbench::scene
