#pragma once
// Writes a scene of lights and standing cameras as glTF text, such that load_gltf() gives the same numbers back. For
// scenes that the tool finds by itself and hands to a person.

#include <string>

#include "scene/scene.h"

namespace clusterbench::scene {

// Nodes, lights with their resolved ranges, cameras. Animations and boxes are left out. Ranges must be finite.
std::string to_gltf(const Scene& scene, const std::string& generator);

}  // namespace clusterbench::scene
