#pragma once
// The part of a glTF document that this tool reads, checked. What it does not read (meshes, materials, images, skins,
// unknown extensions) is neither looked at nor copied, so nothing wrong in there can hurt.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scene/gltf_place.h"

namespace clusterbench::scene {

// A glTF document with asset, scene, scenes, nodes, cameras, KHR_lights_punctual and the animation channels that move
// nodes. Indices are in range, nodes form a forest, numbers are finite, transforms are possible. Accessors, bufferViews
// and buffers stay in `root` (see gltf_accessor.h). Throws Error at the first fault; doubts go to `warnings`.
nlohmann::json checked_document(const Place& root, std::vector<std::string>& warnings);

// Its parts, each in its own file.
nlohmann::json checked_nodes(const Place& root);
nlohmann::json checked_cameras(const Place& root, std::vector<std::string>& warnings);
nlohmann::json checked_lights(const Place& root, std::vector<std::string>& warnings);
nlohmann::json checked_animations(const Place& root, std::vector<std::string>& warnings);

// How far from 1 a quaternion's length may be: what 8-bit components can be off, as in the Khronos glTF validator.
inline constexpr double k_unit_tolerance = 0.00769;

// Elements of a top-level array, 0 if it is absent.
std::size_t count_of(const Place& root, const std::string& key);

// "pointer: message", for warnings.
std::string warning_at(const Place& place, const std::string& message);

// Copies object[key] as a string if it is there.
void copy_name(const Place& object, nlohmann::json& out);

}  // namespace clusterbench::scene
