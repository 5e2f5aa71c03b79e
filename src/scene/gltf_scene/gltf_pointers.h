#pragma once
// The targets of JSON pointers of KHR_animation_pointer.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "scene/scene.h"

namespace clusterbench::scene {

enum class TargetKind : std::uint8_t { node, light, camera };

// The target of an animation channel, by its location in the file.
struct Target {
  TargetKind kind = TargetKind::node;  // light: a definition of KHR_lights_punctual
  std::size_t index = 0;
  ChannelPath path = ChannelPath::translation;
};

// nullopt if this tool does not know the pointer.
std::optional<Target> target_of(const std::string& pointer);

// Whether the pointer leads to materials, textures, meshes or morph weights, which move neither light nor camera.
bool moves_only_appearance(const std::string& pointer);

}  // namespace clusterbench::scene
