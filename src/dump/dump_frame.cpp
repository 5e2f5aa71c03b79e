#include "dump/dump_frame.h"

#include <algorithm>
#include <numeric>

#include "core/error.h"
#include "core/text.h"
#include "dump/camera.h"

namespace clusterbench::dump {
namespace {

Vec2i viewport_of(const result::Dump& dump) {
  return {static_cast<int>(dump.viewport[0]), static_cast<int>(dump.viewport[1])};
}

view::Frame scene_frame(const DumpFile& dump, const result::DumpCamera& given) {
  scene::Scene scene = scene::load_gltf(dump.beside(*given.scene));
  scene::resolve_ranges(scene, {});
  std::vector<std::string> names;
  for (const scene::Camera& camera : scene.cameras) names.push_back(camera.name);
  if (names.empty()) throw Error("", "/camera/scene", "names a scene without a camera");
  const std::string name = given.camera.value_or(names.front());
  const auto found = std::ranges::find(names, name);
  if (found == names.end())
    throw Error("", "/camera/camera",
                "found '" + name + "'" + did_you_mean(name, names) + ", allowed: " + joined(names));
  const scene::Camera& camera = scene.cameras[static_cast<std::size_t>(found - names.begin())];
  const double time_s = given.time_s.value_or(0.0);
  const scene::Shot shot{time_s, scene::camera_pose(scene, camera, time_s),
                         scene::projection_at(scene, camera, time_s)};
  return view::make_frame(scene, shot, 0, viewport_of(dump.record));
}

void mirror(scene::WorldLight& light) {
  light.position.z = -light.position.z;
  light.direction.z = -light.direction.z;
}

// A world grid, as mirror() does with lights.
void mirror_cells(result::DumpGrid& grid) {
  if (grid.bounds) {
    const double low = grid.bounds->lo_m[2];
    grid.bounds->lo_m[2] = -grid.bounds->hi_m[2];
    grid.bounds->hi_m[2] = -low;
  }
  if (grid.planes) {
    std::vector<double>& z = grid.planes->z_m;
    std::ranges::reverse(z);
    for (double& plane : z) plane = -plane;
    grid.planes->origin_m[2] = -grid.planes->origin_m[2];
  }
  grid.first_slice = grid.first_slice.value_or("near") == "far" ? "near" : "far";
}

view::Frame matrix_frame(const DumpFile& dump, const result::DumpCamera& given_camera, bool are_lights_in_view_space,
                         bool& is_world_mirrored) {
  const Camera camera = camera_of(given_camera, are_lights_in_view_space);
  view::Frame frame;
  frame.viewport = viewport_of(dump.record);
  frame.projection = camera.projection;
  frame.view_space = camera.view_space;
  is_world_mirrored = camera.is_world_mirrored;
  return frame;
}

// Points before spots, each in the order of the dump.
void take_lights(DumpFrame& out, const std::vector<scene::WorldLight>& lights) {
  out.dump_index.resize(lights.size());
  std::iota(out.dump_index.begin(), out.dump_index.end(), 0u);
  std::ranges::stable_sort(out.dump_index,
                           [&](std::uint32_t a, std::uint32_t b) { return lights[a].type < lights[b].type; });
  out.frame.lights.clear();
  out.frame_index.resize(lights.size());
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    out.frame.lights.push_back(lights[out.dump_index[i]]);
    out.frame.lights.back().rig_index = static_cast<int>(out.dump_index[i]);
    out.frame_index[out.dump_index[i]] = i;
  }
  out.frame.count_types();
}

// Which of the three ways to give lights a dump has.
std::string kinds_of(const result::DumpLights& given) {
  std::vector<std::string> kinds;
  if (given.rows) kinds.emplace_back("rows");
  if (given.listed) kinds.emplace_back("listed");
  if (given.scene.value_or(false)) kinds.emplace_back("scene");
  return kinds.empty() ? "none" : joined(kinds, " and ");
}

DumpFrame made_frame(const DumpFile& dump, const result::DumpCamera& camera, bool are_lights_in_view_space) {
  const result::DumpLights& given = dump.record.lights;
  const bool of_scene = given.scene.value_or(false), has_scene = !has_matrices(camera);
  if (of_scene + given.rows.has_value() + given.listed.has_value() != 1)
    throw Error("", "/lights", "has " + kinds_of(given) + "; allowed: one of rows, listed and scene");
  if (of_scene && !has_scene) throw Error("", "/lights/scene", "is true, and the camera names no scene");
  if (has_scene && are_lights_in_view_space)
    throw Error("", "/lights/space", "is view; beside the camera of a scene lights are in the world");
  DumpFrame out;
  bool is_world_mirrored = false;
  out.frame =
      has_scene ? scene_frame(dump, camera) : matrix_frame(dump, camera, are_lights_in_view_space, is_world_mirrored);
  std::vector<scene::WorldLight> lights = of_scene ? out.frame.lights : lights_of(dump);
  if (lights.empty()) throw Error("", "/lights", "are none, so there is nothing to check");
  if (is_world_mirrored) std::ranges::for_each(lights, mirror);
  take_lights(out, lights);
  result::DumpGrid grid = dump.record.grid;
  const bool is_world = grid.kind.value_or("frustum") == "world";
  if (is_world && are_lights_in_view_space)
    throw Error("", "/lights/space", "is view; a world grid needs lights in the world");
  out.has_mirrored_cells = is_world && is_world_mirrored;
  if (out.has_mirrored_cells) mirror_cells(grid);
  out.order = order_of(grid);
  out.grid = grid_of(grid, out.frame);
  return out;
}

}  // namespace

assign::Lists DumpFrame::in_frame(assign::Lists lists) const {
  for (std::uint32_t& light : lists.lights) light = frame_index[light];
  assign::make_ascending(lists);
  return lists;
}

DumpFrame frame_of(const DumpFile& dump) {
  return frame_of(dump, dump.record.camera);
}

bool has_lights_in_view_space(const DumpFile& dump) {
  return dump.record.lights.space.value_or("world") == "view";
}

DumpFrame frame_of(const DumpFile& dump, const result::DumpCamera& camera) {
  return frame_of(dump, camera, has_lights_in_view_space(dump));
}

DumpFrame frame_of(const DumpFile& dump, const result::DumpCamera& camera, bool are_lights_in_view_space) {
  try {
    return made_frame(dump, camera, are_lights_in_view_space);
  } catch (const Error& error) {
    if (!error.file().empty()) throw;
    throw Error(dump.path.string(), error.where(), error.message(), error.code());
  }
}

}  // namespace clusterbench::dump
