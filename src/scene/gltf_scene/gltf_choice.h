#pragma once
// The choice of scenes and animations that are read from a file.

#include <optional>

#include "scene/gltf_scene/gltf_checked.h"
#include "scene/scene.h"

namespace clusterbench::scene {

// The meaning of a choice in a document; nullopt if the choice leaves it to the file. Throws Error with the available
// names.
struct ChosenParts {
  std::optional<std::size_t> scene, animation;
};
ChosenParts chosen_parts(const JsonLocation& root, const GltfChoice& choice);

// The available scenes and animations, and which scene is read.
GltfContents contents_of(const JsonLocation& root, const LoadedScene& loaded);

// Warns which of several scenes is read if the choice leaves it to the file.
void warn_of_other_scenes(const JsonLocation& root, const GltfContents& contents);

}  // namespace clusterbench::scene
