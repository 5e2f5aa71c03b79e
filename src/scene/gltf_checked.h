#pragma once
// The part of a glTF document that this tool reads, checked. What it does not read (meshes, materials, images, skins,
// unknown extensions) is neither looked at nor copied, so nothing wrong in there can hurt.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/error.h"
#include "scene/gltf_location.h"

namespace clusterbench::scene {

// A glTF document with asset, scene, scenes, nodes, cameras, KHR_lights_punctual and the animation channels that move
// nodes. Indices are in range, nodes form a forest, numbers are finite, transforms are possible. Accessors, bufferViews
// and buffers stay in `root` (see gltf_accessor.h). Throws Error at the first fault; what is wrong but clear, and what
// is wrong in nodes that are not loaded, is a warning.
nlohmann::json checked_document(const JsonLocation& root);

// The scene that is loaded: the default one, else the first. Faults outside of it are no reason to refuse.
struct LoadedScene {
  std::size_t scene = 0;    // of several; 0 where there are none
  std::vector<bool> nodes;  // which nodes stand in it: all where there is no scene
};
// Walks down without judging: what is broken on the way is left to those who check.
LoadedScene loaded_scene(const JsonLocation& root);

// Its parts, each in its own file.
nlohmann::json checked_nodes(const JsonLocation& root, const LoadedScene& loaded);
nlohmann::json checked_cameras(const JsonLocation& root);
nlohmann::json checked_lights(const JsonLocation& root);
// `lights` and `cameras` are the checked ones. A channel says what it moves by a TargetKind, an index and a
// ChannelPath.
nlohmann::json checked_animations(const JsonLocation& root, const LoadedScene& loaded, const nlohmann::json& lights,
                                  const nlohmann::json& cameras);

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

inline constexpr const char* k_pointers = "KHR_animation_pointer";

// Extras of this tool's own.
inline constexpr const char* k_box = "clusterbench_box";      // of nodes
inline constexpr const char* k_sides = "clusterbench_sides";  // of cameras
// Keys of an object's extras that begin like this tool's own and are none. `own`: those that the object can have.
void warn_of_unknown_extras(const JsonLocation& object, const std::vector<std::string>& own);

// Copies the name if there is one.
void copy_name(const JsonLocation& object, nlohmann::json& out);

}  // namespace clusterbench::scene
