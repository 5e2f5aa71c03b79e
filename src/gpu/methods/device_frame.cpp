#include "gpu/methods/device_frame.h"

#include <algorithm>

#include "assign/bounds/cell_bounds.h"
#include "assign/bounds/cell_extents.h"
#include "core/arrays.h"
#include "core/error.h"
#include "geom/single_precision/box_tests.h"
#include "gpu/methods/arithmetic_probe.h"
#include "gpu/methods/repeated_work.h"

namespace clusterbench::gpu {
namespace {

// A radius and a range whose squares are finite, and beyond all distances of the domain: for lights without an end.
constexpr float k_endless = 1e19f;
constexpr std::uint32_t k_group = 64;

// Roundoffs of ball_touches_box() (common.glsl), as of assign::CellAabbs, which does the same steps. A device that does
// not round to nearest may be off by two roundoffs a step.
constexpr float k_ball_roundoffs = 4.0f, k_cone_slack = 0x1p-19f;
constexpr float k_corner_slack = 0x1p-23f;  // apart.glsl

float steps_of(const DeviceFacts& facts) {
  return facts.rounds_to_nearest ? 1.0f : 2.0f;
}

template <class T>
void upload_all(Commands& commands, Binding binding, const std::vector<T>& data) {
  commands.upload(binding, data.data(), data.size() * sizeof(T));
}

}  // namespace

std::vector<assign::ParamSpec> device_params() {
  std::vector<assign::ParamSpec> params = assign::light_params();
  params.push_back(
      {.name = "cells",
       .summary =
           "where the bounds of cells are made when the projection changes. host: and uploaded; device: of the grid's "
           "boundaries, the same boxes and nearly as small spheres around cells (Operation Black Mesa)",
       .default_value = std::string("host"),
       .unit = "",
       .choices = {"host", "device"}});
  return params;
}

std::string no_device(const assign::Params&) {
  if (std::string obstacle = device_obstacle(); !obstacle.empty()) return obstacle;
  try {
    return contradiction(arithmetic_of_device(), gpu::device().facts());
  } catch (const DeviceError& error) {
    return error.message();
  }
}

std::string no_device_for(const char* shader, const assign::Params& params) {
  std::string obstacle = no_device(params);
  return obstacle.empty() ? gpu::device().obstacle(shader) : obstacle;
}

DeviceFrame::DeviceFrame(const assign::Params& params)
    : device_(&gpu::device()),
      buffers_(*device_),
      test_(params, k_ball_roundoffs * steps_of(device_->facts())),
      is_built_on_device_(params.values().contains("cells") && params.text("cells") == "device") {}

void DeviceFrame::build(const grid::Grid& grid, const assign::LightKinds& kinds) {
  const Vec3i cells = grid.cells();
  arguments_ = {};
  arguments_.cells = grid.cell_count();
  arguments_.columns = static_cast<std::uint32_t>(cells.x);
  arguments_.rows = static_cast<std::uint32_t>(cells.y);
  arguments_.slices = static_cast<std::uint32_t>(cells.z);
  arguments_.column_pitch = arguments_.columns;
  arguments_.row_pitch = arguments_.rows;
  arguments_.first_row = arguments_.columns * arguments_.slices;
  arguments_.first_slice = arguments_.first_row + arguments_.rows * arguments_.slices;
  arguments_.cone_slack = k_cone_slack * steps_of(device_->facts());
  arguments_.corner_slack = k_corner_slack * steps_of(device_->facts());
  arguments_.is_orthographic = grid.screen().tiles.orthographic ? 1 : 0;
  if (is_built_on_device_ || takes_boundaries_) reserve_boundaries(grid.screen());
  if (is_built_on_device_)
    build_on_device(kinds);
  else
    build_on_host(grid, kinds);
}

void DeviceFrame::reserve_boundaries(const grid::ScreenGrid& grid) {
  boundaries_ = grid.tiles.x;
  boundaries_.insert(boundaries_.end(), grid.tiles.y.begin(), grid.tiles.y.end());
  boundaries_.insert(boundaries_.end(), grid.slices.boundaries.begin(), grid.slices.boundaries.end());
  buffers_.reserve(Binding::depths, bytes_of(boundaries_), "boundaries of cells");
}

void DeviceFrame::build_on_host(const grid::Grid& grid, const assign::LightKinds& kinds) {
  const assign::CellExtents extents = assign::cell_extents(grid);
  std::vector<assign::Interval> all = extents.x.extents;
  all.insert(all.end(), extents.y.extents.begin(), extents.y.extents.end());
  all.insert(all.end(), extents.z.extents.begin(), extents.z.extents.end());
  test_.start_grid(grid, kinds);
  has_cell_balls_ = !test_.cell_balls().empty();

  std::vector<Vec4> around_cells;
  for (const geom::Ball& ball : test_.cell_balls())
    around_cells.push_back({ball.center.x, ball.center.y, ball.center.z, std::min(ball.radius, k_endless)});
  buffers_.reserve(Binding::bounds, bytes_of(all), "bounds of cells");
  buffers_.reserve(Binding::cell_balls, bytes_of(around_cells), "balls around cells");
  Commands commands(*device_, buffers_);
  upload_all(commands, Binding::bounds, all);
  upload_all(commands, Binding::cell_balls, around_cells);
  upload_all(commands, Binding::depths, boundaries_);
  commands.run();
}

void DeviceFrame::build_on_device(const assign::LightKinds& kinds) {
  has_cell_balls_ = kinds.spots && test_.tests_cones();
  const std::uint64_t intervals = arguments_.first_slice + arguments_.slices, cells = arguments_.cells;
  buffers_.reserve(Binding::bounds, intervals * sizeof(assign::Interval), "bounds of cells");
  if (has_cell_balls_) buffers_.reserve(Binding::cell_balls, cells * sizeof(Vec4), "balls around cells");
  run_build({});
}

double DeviceFrame::run_build(const assign::DeviceRepeats& repeats) {
  const Kernel bounds = device_->kernel("bounds", k_group, has_cell_balls_ ? 1 : 0);
  Commands commands(*device_, buffers_);
  RepeatedWork work(commands, {.caches = repeats.caches, .run = repeats.build});
  work.record([] {},
              [&] {
                upload_all(commands, Binding::depths, boundaries_);
                commands.barrier();
                commands.dispatch(bounds, arguments_, (std::uint64_t{arguments_.cells} + k_group - 1) / k_group);
              });
  commands.run();
  return work.spans().run_ns;
}

void DeviceFrame::repeat(const assign::DeviceRepeats& repeats) {
  repeats_ = repeats;
  if (repeats.caches == assign::DeviceRepeats::Caches::cold) device_->reserve_flushed();
}

std::optional<double> DeviceFrame::device_build_ns() {
  if (!is_built_on_device_ || boundaries_.empty()) return std::nullopt;
  return run_build(repeats_);
}

std::vector<assign::ShaderStatistic> DeviceFrame::statistics_of(const std::vector<Kernel>& kernels) const {
  std::vector<assign::ShaderStatistic> all;
  for (const Kernel kernel : kernels)
    for (assign::ShaderStatistic& told : device_->statistics(kernel)) all.push_back(std::move(told));
  return all;
}

void DeviceFrame::prepare(const view::LightArrays& lights) {
  if (!lights.spots.empty() && test_.tests_cones() && !has_cell_balls_)
    throw Error("", "lights", "have spots, which the build was not told of", ExitCode::internal);
  pack_balls(lights);
  pack_cones(lights);
  pack_boxes(lights);
  arguments_.lights = count_of(lights);
  arguments_.first_box = lights.boxes.first;
  arguments_.points = lights.points.count;
  arguments_.words = (arguments_.lights + 31) / 32;
  arguments_.tests_cones = cones_.empty() ? 0 : 1;
  buffers_.reserve(Binding::balls, bytes_of(balls_), "balls of lights");
  buffers_.reserve(Binding::cones, bytes_of(cones_), "cones of spots");
  buffers_.reserve(Binding::box_bounds, bytes_of(boxes_), "bounds of boxes");
}

void DeviceFrame::upload(Commands& commands) const {
  upload_all(commands, Binding::balls, balls_);
  upload_all(commands, Binding::cones, cones_);
  upload_all(commands, Binding::box_bounds, boxes_);
  commands.barrier();
}

void DeviceFrame::pack_balls(const view::LightArrays& lights) {
  balls_.clear();
  lights_in_view_ = 0;
  for (std::uint32_t light = 0; light < count_of(lights); ++light) {
    const geom::Ball ball = test_.ball(lights, light, k_ball_roundoffs * steps_of(device_->facts()));
    const bool is_empty =
        lights.is_empty(light) || (view_ && view_->misses(test_.ball(lights, light, assign::k_cell_box_roundoffs)));
    lights_in_view_ += is_empty ? 0 : 1;
    balls_.push_back(
        {ball.center.x, ball.center.y, ball.center.z, is_empty ? -1.0f : std::min(ball.radius, k_endless)});
  }
}

void DeviceFrame::pack_cones(const view::LightArrays& lights) {
  cones_.clear();
  if (!test_.tests_cones()) return;
  for (std::uint32_t light = lights.spots.first; light < lights.spots.end(); ++light) {
    const geom::SphericalCone cone = test_.cone(lights, light);
    cones_.push_back({{cone.apex.x, cone.apex.y, cone.apex.z, std::min(cone.range, k_endless)},
                      {cone.axis.x, cone.axis.y, cone.axis.z, cone.cos_angle},
                      {cone.sin_angle, 0.0f, 0.0f, 0.0f}});
  }
}

// As box-bounds: the device only compares the bounds, so all roundoffs are the host's.
void DeviceFrame::pack_boxes(const view::LightArrays& lights) {
  boxes_.clear();
  const float roundoffs = test_.padding(geom::k_bounds_roundoffs - view::k_given_roundoffs);
  for (std::uint32_t light = lights.boxes.first; light < count_of(lights); ++light) {
    const geom::PaddedBox box = geom::padded(lights.box(light), roundoffs * (0x1p-24f * lights.reach[light]));
    const Vec3f lo = box.box.center - box.extent, hi = box.box.center + box.extent;
    boxes_.push_back({lo.x, lo.y, lo.z, 0.0f});
    boxes_.push_back({hi.x, hi.y, hi.z, 0.0f});
  }
}

std::size_t DeviceFrame::host_bytes() const {
  return bytes_of(balls_, cones_, boxes_, boundaries_) + test_.capacity_bytes();
}

}  // namespace clusterbench::gpu
