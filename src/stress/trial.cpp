#include "stress/trial.h"

#include <algorithm>
#include <cmath>

#include "run/cases/path_frames.h"
#include "scene/camera_path.h"

namespace clusterbench::stress {
Rig::Rig() {
  scene_.nodes.push_back({.name = "camera"});
  scene::Camera camera;
  camera.name = "camera";
  camera.node = 0;
  camera.projection.yfov_rad = 3.14159265358979323846 / 3.0;
  camera.projection.near_m = 0.1;
  camera.projection.far_m = 500.0;
  scene_.cameras.push_back(camera);
}

int Rig::node(const scene::Node& node) {
  scene_.nodes.push_back(node);
  return static_cast<int>(scene_.nodes.size()) - 1;
}

Rig& Rig::point(const Vec3d& position, double range_m, int parent) {
  scene::Light light;
  light.name = "light " + std::to_string(scene_.lights.size());
  light.node = node({.name = light.name, .parent = parent, .translation = position});
  light.range_m = range_m;
  scene_.lights.push_back(light);
  return *this;
}

Rig& Rig::spot(const Vec3d& position, const Vec3d& direction, double range_m, double half_angle_rad) {
  point(position, range_m);
  scene::Light& light = scene_.lights.back();
  light.type = scene::LightType::spot;
  light.inner_cone_rad = 0.0;
  light.outer_cone_rad = half_angle_rad;
  scene_.nodes.back().rotation = scene::rotation_towards(direction);
  return *this;
}

Rig& Rig::look(const Vec3d& eye, double yaw_rad) {
  scene_.nodes[0].translation = eye;
  scene_.nodes[0].rotation = {0.0, std::sin(yaw_rad / 2.0), 0.0, std::cos(yaw_rad / 2.0)};
  return *this;
}

Rig& Rig::show(Vec2i viewport) {
  viewport_ = viewport;
  return *this;
}

Trial Rig::on(const grid::GridSpec& grid, const std::string& label) const {
  return {label, scene_, viewport_, grid, false};
}

void Rig::on_each(const std::vector<grid::GridSpec>& grids, const std::string& label,
                  std::vector<Trial>& trials) const {
  for (const grid::GridSpec& grid : grids) trials.push_back(on(grid, label));
}

grid::GridSpec frustum_grid(Vec2i tiles, grid::Scheme scheme, int slices, double near_m, double far_m, double first_m) {
  grid::GridSpec spec;
  spec.tiles = {{0, 0}, tiles};
  spec.slices.scheme = scheme;
  spec.slices.count = slices;
  spec.slices.near_m = near_m;
  spec.slices.first_m = first_m;
  spec.slices.far_m = far_m;
  return spec;
}

grid::GridSpec pixel_grid(Vec2i tile_pixels) {
  grid::GridSpec spec = frustum_grid({0, 0}, grid::Scheme::exponential_first, 16, 0.1, 500.0);
  spec.tiles = {tile_pixels, {0, 0}};
  return spec;
}

std::vector<grid::GridSpec> grids_of_every_kind() {
  grid::GridSpec distance = pixel_grid({128, 128}), cascades, world;
  distance.kind = grid::Kind::distance;
  cascades.kind = grid::Kind::cascades;
  cascades.cells = {12, 12, 12};
  world.kind = grid::Kind::world;
  world.cells = {24, 8, 24};
  return {pixel_grid({128, 128}), frustum_grid({12, 12}, grid::Scheme::exponential, 24, 0.1, 400.0), distance, cascades,
          world};
}

bool has_boxes(const Trial& trial) {
  return std::ranges::any_of(trial.scene.lights,
                             [](const scene::Light& light) { return light.type == scene::LightType::box; });
}

view::Frame frame_of(const Trial& trial) {
  const std::vector<scene::CameraPath> paths = scene::camera_paths(trial.scene, {});
  return view::make_frame(trial.scene, paths.front().shots.front(), 0, trial.viewport);
}

grid::Grid grid_of(const Trial& trial, const view::Frame& frame) {
  const std::vector<scene::CameraPath> paths = scene::camera_paths(trial.scene, {});
  const run::PathFrames path(trial.scene, paths.front(), trial.viewport);
  return grid::make_grid(trial.grid, path.inputs(trial.grid, frame));
}

depth::DepthImage depths_for(const assign::AssignerDescriptor& assigner, const view::Frame& frame) {
  return assigner.needs.depth ? depth::seeded_depths(frame, 1) : depth::DepthImage{};
}

assign::FrameInput input_of(const view::Frame& frame, const view::LightArrays& lights,
                            const depth::DepthImage& depths) {
  return {frame, lights, depths.nearest.empty() ? nullptr : &depths};
}

}  // namespace clusterbench::stress
