#pragma once
// The part of a glTF document that this tool reads, checked. Other parts (meshes, materials, images, skins, unknown
// extensions) are neither read nor copied, so errors in them do no harm.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "scene/gltf_document/gltf_location.h"
#include "scene/scene.h"

namespace clusterbench::scene {

// The scene that is loaded: the chosen one, else the default one, else the first. Errors outside of it do not stop
// loading.
struct LoadedScene {
  std::size_t scene = 0;    // of several; 0 if there are none
  std::vector<bool> nodes;  // the nodes that belong to it: all if there is no scene
};
// Walks down without checks: errors on the way are reported by the checking functions.
LoadedScene loaded_scene(const JsonLocation& root, std::optional<std::size_t> chosen);

// For each of possibly millions of nodes, the facts needed while the others are checked. The rest of a node is read
// again when it is added to the scene.
struct NodeTable {
  std::vector<std::int32_t> light, camera;  // definitions; -1: none
  std::vector<bool> has_transform;
  std::vector<std::uint32_t> children, first_child;  // those of node i: from first_child[i] to first_child[i + 1]

  std::size_t size() const { return light.size(); }
  std::span<const std::uint32_t> children_of(std::size_t node) const {
    return {children.data() + first_child[node], children.data() + first_child[node + 1]};
  }
};

// asset, scene, scenes, nodes, cameras, KHR_lights_punctual and the animation channels that move nodes. Indices are in
// range, nodes form a forest, numbers are finite, transforms are possible. Accessors, bufferViews and buffers stay in
// the document (see gltf_accessor.h).
struct CheckedDocument {
  NodeTable nodes;
  std::vector<std::uint32_t> roots;              // of the loaded scene, in their order
  std::vector<std::optional<Camera>> cameras;    // definitions; nullopt: of a kind that this tool does not know
  std::vector<std::optional<LightType>> lights;  // definitions; nullopt: of a kind that this tool does not know
  nlohmann::json animations;
};
// Throws Error at the first error; a recoverable mistake, and an error in nodes that are not loaded, is a warning.
// `animation`: read only this one; nullopt: all.
CheckedDocument checked_document(const JsonLocation& root, const LoadedScene& loaded,
                                 std::optional<std::size_t> animation);

// Its parts, each in its own file.
NodeTable checked_nodes(const JsonLocation& root, const LoadedScene& loaded);
std::vector<std::optional<Camera>> checked_cameras(const JsonLocation& root);
std::vector<std::optional<LightType>> checked_lights(const JsonLocation& root);
// A channel identifies its property by a TargetKind, an index and a ChannelPath.
nlohmann::json checked_animations(const JsonLocation& root, const LoadedScene& loaded, const CheckedDocument& document,
                                  std::optional<std::size_t> animation);

// A node and a light definition, read: nullopt for a light of an unknown kind. Each function checks its input, so it
// may be the first to read it.
struct ReadNode {
  Node node;
  std::optional<Vec3d> box_half_extents_m;
  std::int32_t light = -1, camera = -1;
  std::vector<std::uint32_t> children;
};
ReadNode read_node(const JsonLocation& root, const JsonLocation& node, std::size_t nodes);
std::optional<Light> read_light(const JsonLocation& light);
// The location of the light definitions; nullopt if there are none.
std::optional<JsonLocation> light_definitions(const JsonLocation& root);

// Largest deviation of a quaternion's length from 1: the error of 8-bit components, as in the Khronos glTF validator.
inline constexpr double k_unit_tolerance = 0.00769;

// pi/2 rounded up to single precision, as exporters write it, is still pi/2.
inline constexpr double k_angle_slack_rad = 1e-6;

// Elements of a top-level array, 0 if it is absent.
std::size_t count_of(const JsonLocation& root, const std::string& key);

// An error in a part of the document that is not loaded.
void warn_of_unloaded(const JsonLocation& location, const Error& fault);

// Whether the extension is in extensionsRequired.
bool is_required(const JsonLocation& root, const std::string& extension);

inline constexpr const char* k_punctual = "KHR_lights_punctual";
inline constexpr const char* k_pointers = "KHR_animation_pointer";

// Extras defined by this tool.
inline constexpr const char* k_box = "clusterbench_box";      // of nodes
inline constexpr const char* k_sides = "clusterbench_sides";  // of cameras
// Warns of keys in an object's extras that look like this tool's own but are unknown. `own`: the keys that the object
// can have.
void warn_of_unknown_extras(const JsonLocation& object, const std::vector<std::string>& own);

// The name, "" if there is none.
std::string name_of(const JsonLocation& object);

}  // namespace clusterbench::scene
