#pragma once
// Whether what is sampled from a scene lies in the domain (geom/shapes/domain.h). Numbers in a file can each be fine
// and make positions, by nested and animated transforms, that are not.

#include <span>
#include <string>

#include "scene/camera_path.h"
#include "scene/scene.h"

namespace clusterbench::scene {

// Each throws Error (the scene's file, the node) with the light's or the camera's name, the value and the time.
void check_domain(const Scene& scene, std::span<const WorldLight> lights, double time_s);
void check_domain(const Scene& scene, const std::string& camera, const Shot& shot);
// All frames of a path, before any of them is used.
void check_domain(const Scene& scene, const CameraPath& path);

}  // namespace clusterbench::scene
