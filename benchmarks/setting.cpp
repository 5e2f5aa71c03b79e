#include "setting.h"

#include "scene/camera_path.h"

namespace clusterbench {

Setting make_setting(const std::string& file, const grid::GridSpec& spec, double share_of_path, float range_m) {
  scene::Scene scene = scene::load_gltf(file);
  scene::resolve_ranges(scene, {});
  if (range_m > 0.0f)
    for (scene::Light& light : scene.lights) light.range_m = range_m;
  const scene::CameraPath path = scene::camera_paths(scene, {}).front();
  const auto shot = static_cast<std::size_t>(share_of_path * static_cast<double>(path.shots.size() - 1));
  Setting setting;
  setting.frame = view::make_frame(scene, path.shots[shot], 0, {1920, 1080});
  setting.grid = grid::make_grid(spec, grid::grid_inputs(spec, setting.frame, 0.0, {-250, -50, -250}, {250, 80, 250}));
  setting.lights = view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame));
  return setting;
}

std::string own_scene(const std::string& name) {
  return CLUSTERBENCH_SOURCE_DIR "/scenes/" + name + ".glb";
}

std::string peer_workload(const std::string& name) {
  return CLUSTERBENCH_SOURCE_DIR "/scenes/peers/" + name + ".gltf";
}

}  // namespace clusterbench
