#pragma once
// Checks that samples of a scene lie in the domain (geom/shapes/domain.h). Nested and animated transforms can produce
// positions outside of it, even if each number in the file is valid.

#include <span>
#include <string>

#include "scene/camera_path.h"
#include "scene/scene.h"

namespace clusterbench::scene {

// Each throws Error (the scene's file, the node) with the name of the light or camera, the value and the time.
void check_domain(const Scene& scene, std::span<const WorldLight> lights, double time_s);
void check_domain(const Scene& scene, const std::string& camera, const Shot& shot);
// Checks all frames of a path before any of them is used. Throws the same on any number of threads.
void check_domain(const Scene& scene, const CameraPath& path, int threads = 1);

}  // namespace clusterbench::scene
