#pragma once
// The part of a glTF document that this tool reads, checked. What it does not read (meshes, materials, images, skins,
// unknown extensions) is neither looked at nor copied, so nothing wrong in there can hurt.

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

// The scene that is loaded: the chosen one, else the default one, else the first. Faults outside of it are no reason to
// refuse.
struct LoadedScene {
  std::size_t scene = 0;    // of several; 0 where there are none
  std::vector<bool> nodes;  // which nodes stand in it: all where there is no scene
};
// Walks down without judging: what is broken on the way is left to those who check.
LoadedScene loaded_scene(const JsonLocation& root, std::optional<std::size_t> chosen);

// Of all nodes, which may be millions, what has to be known of each while the others are looked at. The rest of a node
// is read once more where it is placed.
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
  std::vector<std::uint32_t> roots;              // of the scene that is loaded, in their order
  std::vector<std::optional<Camera>> cameras;    // definitions; nothing: of a kind that this tool does not know
  std::vector<std::optional<LightType>> lights;  // likewise
  nlohmann::json animations;
};
// Throws Error at the first fault; what is wrong but clear, and what is wrong in nodes that are not loaded, is a
// warning. `animation`: the only one that is read; nothing: all.
CheckedDocument checked_document(const JsonLocation& root, const LoadedScene& loaded,
                                 std::optional<std::size_t> animation);

// Its parts, each in its own file.
NodeTable checked_nodes(const JsonLocation& root, const LoadedScene& loaded);
std::vector<std::optional<Camera>> checked_cameras(const JsonLocation& root);
std::vector<std::optional<LightType>> checked_lights(const JsonLocation& root);
// A channel says what it moves by a TargetKind, an index and a ChannelPath.
nlohmann::json checked_animations(const JsonLocation& root, const LoadedScene& loaded, const CheckedDocument& document,
                                  std::optional<std::size_t> animation);

// A node and a light definition, read: nothing for a light of a kind that this tool does not know. Each checks, so that
// it may be the first to read.
struct ReadNode {
  Node node;
  std::optional<Vec3d> box_half_extents_m;
  std::int32_t light = -1, camera = -1;
  std::vector<std::uint32_t> children;
};
ReadNode read_node(const JsonLocation& root, const JsonLocation& node, std::size_t nodes);
std::optional<Light> read_light(const JsonLocation& light);
// Where the light definitions stand; nothing where there are none.
std::optional<JsonLocation> light_definitions(const JsonLocation& root);

// How far from 1 a quaternion's length may be: what 8-bit components can be off, as in the Khronos glTF validator.
inline constexpr double k_unit_tolerance = 0.00769;

// pi/2 rounded up to single precision, as exporters write it, is still pi/2.
inline constexpr double k_angle_slack_rad = 1e-6;

// Elements of a top-level array, 0 if it is absent.
std::size_t count_of(const JsonLocation& root, const std::string& key);

// A fault in a part of the document that is not loaded.
void warn_of_unloaded(const JsonLocation& location, const Error& fault);

// Is the extension in extensionsRequired?
bool is_required(const JsonLocation& root, const std::string& extension);

inline constexpr const char* k_punctual = "KHR_lights_punctual";
inline constexpr const char* k_pointers = "KHR_animation_pointer";

// Extras of this tool's own.
inline constexpr const char* k_box = "clusterbench_box";      // of nodes
inline constexpr const char* k_sides = "clusterbench_sides";  // of cameras
// Keys of an object's extras that begin like this tool's own and are none. `own`: those that the object can have.
void warn_of_unknown_extras(const JsonLocation& object, const std::vector<std::string>& own);

// The name, "" if there is none.
std::string name_of(const JsonLocation& object);

}  // namespace clusterbench::scene
