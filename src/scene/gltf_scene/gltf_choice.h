#pragma once
// Which of a file's scenes and animations are read.

#include <optional>

#include "scene/gltf_scene/gltf_checked.h"
#include "scene/scene.h"

namespace clusterbench::scene {

// What a choice means in a document; nothing where it leaves it to the file. Throws Error that names what there is.
struct ChosenParts {
  std::optional<std::size_t> scene, animation;
};
ChosenParts chosen_parts(const JsonLocation& root, const GltfChoice& choice);

// What there is to choose from, and which scene is read.
GltfContents contents_of(const JsonLocation& root, const LoadedScene& loaded);

// Says which scene of several is read where the choice leaves it to the file.
void warn_of_other_scenes(const JsonLocation& root, const GltfContents& contents);

}  // namespace clusterbench::scene
