#pragma once
// Lights of a file that are not read: of other scenes, and of other extensions than KHR_lights_punctual.

#include "scene/gltf_scene/gltf_checked.h"
#include "scene/scene.h"

namespace clusterbench::scene {

// Warns of them and counts them in `contents`, whose scenes are filled in.
void count_unread_lights(const JsonLocation& root, const LoadedScene& loaded, GltfContents& contents);

}  // namespace clusterbench::scene
