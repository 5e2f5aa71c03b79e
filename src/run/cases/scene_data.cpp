#include "run/cases/scene_data.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <set>

#include "core/error.h"
#include "core/libraries.h"
#include "core/text.h"
#include "run/cases/case_names.h"
#include "run/cases/frame_work.h"
#include "run/cases/path_frames.h"
#include "scene/domain_check.h"

namespace clusterbench::run {
namespace {

// For anything that is counted.
bool needs_triangles(const config::Config& config) {
  return std::ranges::any_of(config.sample_sets, &config::SampleSetRequest::needs_triangles) ||
         !config.shadow_culls.empty() ||
         std::ranges::any_of(
             config.assigners,
             [](const config::MethodRequest& method) { return assign::find_assigner(method.name)->needs.depth; }) ||
         std::ranges::any_of(config.grids, follows_surfaces) ||
         std::ranges::any_of(config.pre_culls, &cull::PreCullSpec::needs_triangles);
}

scene::Scene scene_of_file(const config::SceneRequest& request) {
  std::error_code unknown;
  if (!request.named_by.empty() && !std::filesystem::exists(request.path, unknown) && !unknown)
    throw Error(request.named_by, request.named_at, "names '" + request.path.string() + "', and there is no such file");
  return scene::load_gltf(request.path, request.choice);
}

// Loads the scene, resolves its lights' ranges, and makes lights of its boxes on request.
scene::Scene resolved_scene(const config::SceneRequest& request, SceneFiles* files) {
  scene::Scene scene = request.rig        ? scene::make_rig(*request.rig)
                       : files != nullptr ? files->scene(request)
                                          : scene_of_file(request);
  scene::resolve_ranges(scene, request.range_rule);
  if (request.boxes)
    scene::assign_boxes(scene);
  else if (!scene.boxes.empty())
    scene.warnings.push_back("its oriented boxes (" + std::to_string(scene.boxes.size()) +
                             ") are counted and not assigned; --set 'scenes.*.boxes=true' assigns them");
  return scene;
}

void check_paths(const SceneData& data, int threads) {
  for (const scene::CameraPath& path : data.paths) scene::check_domain(data.scene, path, threads);
}

// Sets the numbers that depend on how many lights reach a point: fewer frames, and grids that are not compared cell by
// cell.
void weigh_frames(const config::Config& config, const config::SceneRequest& request, SceneData& data) {
  if (request.camera.most_lights == 0.0 && !config.accuracy.most_pairs) return;
  for (std::size_t camera = 0; camera < data.paths.size(); ++camera)
    data.lights_at_points.push_back(lights_at_a_point(path_of(config, data, camera, 0), config.seed));
  if (request.camera.most_lights == 0.0) return;
  scene::PathRequest fewer = request.camera;
  fewer.count = frames_within(fewer.count, fewer.most_lights, data.paths, data.lights_at_points);
  if (fewer.count == request.camera.count) return;
  data.requested_frames = request.camera.count;
  data.equal_steps = fewer.count;
  data.paths = scene::camera_paths(data.scene, fewer);
  data.path_lights = std::make_shared<PathLightsOfScene>();
  check_paths(data, config.threads);
}

void name_paths(SceneData& data) {
  UniqueNames cameras;
  for (scene::CameraPath& path : data.paths) path.camera = cameras.add(name_part(path.camera));
}

double lowest_height(const SceneData& data) {
  constexpr double k_eye_height_m = 1.7;
  double lowest_m = std::numeric_limits<double>::infinity();
  for (const scene::CameraPath& path : data.paths)
    for (const scene::Shot& shot : path.shots) {
      lowest_m = std::min(lowest_m, shot.pose.eye.y - k_eye_height_m);
      for (const scene::WorldLight& light : scene::world_lights(data.scene, shot.time_s))
        if (light.range_m > 0.0) lowest_m = std::min(lowest_m, light.position.y);
    }
  return lowest_m;
}

// Finds the floor for sets of samples, those of readings included, and adds a note with its height.
void lay_ground(const config::Config& config, SceneData& data) {
  std::set<std::string> notes;
  for (const auto* sets : {&config.sample_sets, &config.reading_sets})
    for (const config::SampleSetRequest& request : *sets) {
      if (!request.ground || data.has_triangles()) continue;
      if (request.ground->is_lowest) data.lowest_m = lowest_height(data);
      char height[32];
      std::snprintf(height, sizeof height, "%.4g", *ground_height(request, data));
      notes.insert("no triangles: its opaque samples lie on a floor at y = " + std::string(height) +
                   " m (samples.opaque.ground), and none above the horizon");
    }
  data.scene.warnings.insert(data.scene.warnings.end(), notes.begin(), notes.end());
}

// `names`: those of earlier scenes; adds this one's.
SceneData scene_data(const config::Config& config, const config::SceneRequest& request, SceneFiles* files,
                     UniqueNames& names) {
  SceneData data;
  data.scene = resolved_scene(request, files);
  data.scene.name = names.add(name_part(data.scene.name));
  data.paths = scene::camera_paths(data.scene, request.camera);
  check_paths(data, config.threads);
  weigh_frames(config, request, data);
  name_paths(data);
  data.counts_triangles = needs_triangles(config);
  const bool reads_triangles = std::ranges::any_of(config.reading_sets, &config::SampleSetRequest::needs_triangles);
  if ((data.counts_triangles || reads_triangles) && !request.rig) {
    data.geometry = scene::load_geometry(data.scene);
    const std::vector<std::string>& warnings = data.geometry->warnings;
    data.scene.warnings.insert(data.scene.warnings.end(), warnings.begin(), warnings.end());
  }
  lay_ground(config, data);
  return data;
}

}  // namespace

bool SceneData::has_lights(scene::LightType type) const {
  return std::ranges::find(scene.lights, type, &scene::Light::type) != scene.lights.end();
}

std::string SceneData::surface_obstacle() const {
  return has_triangles() ? missing_library(Library::embree) : "the scene has no triangles";
}

std::string SceneData::contents_sha256() const {
  return geometry && counts_triangles ? sha256_hex(scene.sha256 + geometry->sha256) : scene.sha256;
}

scene::Scene SceneFiles::scene(const config::SceneRequest& request) {
  const auto same = [&](const ReadScene& read) { return read.path == request.path && read.choice == request.choice; };
  const auto known = std::ranges::find_if(read_, same);
  if (known != read_.end()) return known->scene;
  return read_.emplace_back(ReadScene{request.path, request.choice, scene_of_file(request)}).scene;
}

std::vector<SceneData> load_scenes(const config::Config& config, SceneFiles* files) {
  std::vector<SceneData> scenes;
  UniqueNames names;
  for (const config::SceneRequest& request : config.scenes) scenes.push_back(scene_data(config, request, files, names));
  for (SceneData& data : scenes)  // their final address
    if (data.surface_obstacle().empty()) {
      data.depths = std::make_shared<FrameDepths>(data.scene, *data.geometry);
      data.visible_sets = std::make_shared<SceneVisibleSets>(data.scene, *data.geometry);
    }
  return scenes;
}

bool follows_surfaces(const grid::GridSpec& grid) {
  return grid.has_tiles() && grid.slices.fit && grid.slices.fit->needs_surfaces();
}

std::optional<double> ground_height(const config::SampleSetRequest& request, const SceneData& data) {
  if (!request.ground || data.has_triangles()) return {};
  return request.ground->is_lowest ? data.lowest_m : request.ground->height_m;
}

}  // namespace clusterbench::run
