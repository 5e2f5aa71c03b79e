#include "scene/gltf_checked.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>

namespace clusterbench::scene {
namespace {

using nlohmann::json;

// "major.minor" as two numbers.
std::pair<long, long> version_of(const Place& place) {
  const std::string& text = place.text();
  const std::size_t dot = text.find('.');
  const auto digits = [](std::string_view part) {
    return !part.empty() && part.size() <= 9 &&
           std::all_of(part.begin(), part.end(), [](char c) { return c >= '0' && c <= '9'; });
  };
  if (dot == std::string::npos || !digits(std::string_view(text).substr(0, dot)) ||
      !digits(std::string_view(text).substr(dot + 1))) {
    place.refuse("found '" + text.substr(0, 40) + "', a version such as 2.0 is needed");
  }
  return {std::stol(text.substr(0, dot)), std::stol(text.substr(dot + 1))};
}

void check_asset(const Place& root, std::vector<std::string>& warnings) {
  const Place asset = root.at("asset");
  const auto version = version_of(asset.at("version"));
  if (version.first != 2) {
    asset.at("version").refuse("glTF " + asset.at("version").text() + " found, glTF 2.x is needed");
  }
  if (version.second != 0) warnings.push_back(warning_at(asset.at("version"), "read as glTF 2.0"));
  if (!asset.has("minVersion")) return;
  const Place min_version = asset.at("minVersion");
  const auto least = version_of(min_version);
  if (least > version) min_version.refuse("greater than the asset's version");
}

// Extensions that a file may require although this tool does not know them: they speak of meshes, textures, materials.
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
                                     "KHR_animation_pointer"};
  return std::any_of(k_harmless.begin(), k_harmless.end(),
                     [&](const char* prefix) { return name.starts_with(prefix); });
}

void check_extensions(const Place& root, std::vector<std::string>& warnings) {
  if (!root.has("extensionsRequired")) return;
  const Place required = root.at("extensionsRequired");
  required.expect_array();
  for (std::size_t i = 0; i < required.size(); ++i) {
    const std::string name = required.at(i).text();
    if (name == "EXT_mesh_gpu_instancing") {
      warnings.push_back(warning_at(required.at(i), "EXT_mesh_gpu_instancing multiplies meshes only, never lights"));
    } else if (!changes_no_light(name)) {
      warnings.push_back(warning_at(required.at(i), "the extension '" + name + "' is not known and ignored"));
    }
  }
}

json checked_scenes(const Place& root, const json& nodes) {
  json out = json::array();
  if (!root.has("scenes")) return out;
  std::vector<char> is_child(nodes.size(), 0);
  for (const json& node : nodes) {
    for (const json& child : node.value("children", json::array())) is_child[child.get<std::size_t>()] = 1;
  }
  const Place scenes = root.at("scenes");
  scenes.expect_array();
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Place scene = scenes.at(i);
    scene.expect_object();
    json roots = json::array();
    if (scene.has("nodes")) {
      const Place list = scene.at("nodes");
      list.expect_array();
      std::set<std::size_t> seen;
      for (std::size_t k = 0; k < list.size(); ++k) {
        const std::size_t node = list.at(k).index(nodes.size(), "node");
        if (is_child[node]) list.at(k).refuse("node " + std::to_string(node) + " has a parent; a scene lists roots");
        if (!seen.insert(node).second) list.at(k).refuse("node " + std::to_string(node) + " is listed twice");
        roots.push_back(node);
      }
    }
    out.push_back({{"nodes", std::move(roots)}});
  }
  return out;
}

// What is null in `definitions` is of a kind that this tool does not know: nobody refers to it any more, and `stand_in`
// keeps its place.
template <typename Forget>
void drop_unknown(json& definitions, json& nodes, const json& stand_in, Forget forget) {
  for (json& node : nodes) forget(node, definitions);
  for (json& definition : definitions) {
    if (definition.is_null()) definition = stand_in;
  }
}

void drop_unknown_cameras(json& document) {
  const json stand_in = {{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 1.0}}}};
  drop_unknown(document["cameras"], document["nodes"], stand_in, [](json& node, const json& cameras) {
    if (node.contains("camera") && cameras[node["camera"].get<std::size_t>()].is_null()) node.erase("camera");
  });
}

void drop_unknown_lights(json& document) {
  const json stand_in = {{"type", "point"}};
  json& lights = document["extensions"]["KHR_lights_punctual"]["lights"];
  drop_unknown(lights, document["nodes"], stand_in, [](json& node, const json& definitions) {
    if (!node.contains("extensions")) return;
    const std::size_t light = node["extensions"]["KHR_lights_punctual"]["light"].get<std::size_t>();
    if (definitions[light].is_null()) node.erase("extensions");
  });
}

}  // namespace

std::size_t count_of(const Place& root, const std::string& key) {
  if (!root.has(key)) return 0;
  root.at(key).expect_array();
  return root.at(key).size();
}

std::string warning_at(const Place& place, const std::string& message) {
  return place.pointer() + ": " + one_line(message);
}

void copy_name(const Place& object, json& out) {
  if (object.has("name")) out["name"] = object.at("name").text();
}

json checked_document(const Place& root, std::vector<std::string>& warnings) {
  root.expect_object();
  check_asset(root, warnings);
  check_extensions(root, warnings);
  json out = {{"asset", {{"version", "2.0"}}}};
  out["nodes"] = checked_nodes(root);
  out["scenes"] = checked_scenes(root, out["nodes"]);
  if (root.has("scene")) out["scene"] = root.at("scene").index(out["scenes"].size(), "scene");
  out["cameras"] = checked_cameras(root, warnings);
  out["extensions"] = {{"KHR_lights_punctual", {{"lights", checked_lights(root, warnings)}}}};
  out["animations"] = checked_animations(root, warnings);
  drop_unknown_cameras(out);
  drop_unknown_lights(out);
  return out;
}

}  // namespace clusterbench::scene
