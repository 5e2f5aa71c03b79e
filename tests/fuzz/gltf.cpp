// A scene file: .gltf text or .glb. What loads must be usable: ranges, poses, lights at its beginning and end,
// triangles.

#include "core/memory.h"
#include "fuzz/input.h"
#include "scene/camera_path.h"
#include "scene/geometry.h"
#include "scene/scene.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace clusterbench;
  return fuzz::answered([&] {
    const bool is_binary = size >= 4 && std::string(data, data + 4) == "glTF";
    scene::Scene scene = scene::load_gltf(fuzz::written(data, size, is_binary ? ".glb" : ".gltf"));
    scene::resolve_ranges(scene, {});
    for (const double time_s : {0.0, scene.duration_s}) {
      static_cast<void>(scene::world_lights(scene, time_s));
      for (const scene::Camera& camera : scene.cameras) static_cast<void>(scene::camera_pose(scene, camera, time_s));
    }
    scene::PathRequest request;
    request.count = 3;
    static_cast<void>(scene::camera_paths(scene, request));
    const MemoryLimitScope limit(std::uint64_t{64} << 20);
    static_cast<void>(scene::load_geometry(scene));
  });
}
