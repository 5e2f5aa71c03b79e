#pragma once
// Writes a scene of lights and cameras as glTF text, such that load_gltf() gives the same numbers back. For scenes that
// the tool finds and hands to a user.

#include <string>

#include "scene/scene.h"

namespace clusterbench::scene {

// Nodes, lights with their resolved ranges, cameras, and channels: of nodes translation and rotation, of lights range
// and outer angle, all with interpolation `step`. glTF stores the values of channels in single precision, so other
// numbers are rounded. Boxes are written if they are assigned (assign_boxes). Other channels are left out. Ranges must
// be finite.
std::string to_gltf(const Scene& scene, const std::string& generator);

}  // namespace clusterbench::scene
