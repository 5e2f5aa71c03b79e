#pragma once
// A glTF file with more cameras: the other eye, a second player, the faces of a probe.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geom/shapes/vec.h"
#include "scene/scene.h"

namespace clusterbench::scene {

// A camera like another one, which moves with it.
struct AddedView {
  std::string name;
  Vec3d offset_m{0.0};    // in the other camera's own space: x to its right, y up, -z ahead
  double turned_deg = 0;  // to its left, around its y
};

struct ViewsRequest {
  std::string camera;  // to which views are added; "": the first animated one, else the first
  std::vector<AddedView> views;
  std::optional<Vec3d> faces_at_m;  // six square cameras of 90 degrees along the world's axes: face-px ... face-nz
};

// The bytes of the scene's file with these cameras added; the rest is unchanged. `out`, the destination, must have the
// same format (.gltf, .glb). Throws Error for an impossible camera or name, and if a .gltf would lose files that it
// refers to.
std::string with_views(const Scene& scene, const ViewsRequest& request, const std::filesystem::path& out);

}  // namespace clusterbench::scene
