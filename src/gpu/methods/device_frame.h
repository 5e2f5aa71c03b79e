#pragma once
// The input of all methods, on the device: the bounds of a grid's cells, and the lights of a frame as balls and cones,
// padded by the error of the shaders' tests.

#include <optional>
#include <vector>

#include "assign/contract/light_test.h"
#include "assign/grid_cull/view_cull.h"
#include "gpu/methods/frame_arguments.h"

namespace clusterbench::gpu {

class DeviceFrame {
 public:
  explicit DeviceFrame(const assign::Params& params);

  // Makes the bounds of a frustum grid's cells, and the balls around them if cones are tested: on the host, or on the
  // device of the grid's boundaries.
  void build(const grid::Grid& grid, const assign::LightKinds& kinds);
  // From now on prepare() packs lights beside this grid's view as empty ones, as engines do that cull on the host.
  void cull(const grid::ScreenGrid& grid) { view_ = assign::ViewCull(grid); }
  // From now on prepare() also packs boxes, by the axis-aligned boxes around them.
  void take_boxes() { takes_boxes_ = true; }
  // From now on build() brings the grid's boundaries to the device, too (boundaries.glsl).
  void take_boundaries() { takes_boundaries_ = true; }
  // The number of lights that prepare() packs.
  std::uint32_t count_of(const view::LightArrays& lights) const {
    return takes_boxes_ ? lights.size() : lights.boxes.first;
  }
  // How what follows is repeated and timed.
  void repeat(const assign::DeviceRepeats& repeats);
  const assign::DeviceRepeats& repeats() const { return repeats_; }
  // Does what the device did of the last build() again; none if that was only to copy.
  std::optional<double> device_build_ns();
  std::vector<assign::ShaderStatistic> statistics_of(const std::vector<Kernel>& kernels) const;
  // Packs a frame's lights, and makes room for them. Before commands are recorded, as all that makes room.
  void prepare(const view::LightArrays& lights);
  // Records the upload of the lights of the last prepare(), and the barrier behind it.
  void upload(Commands& commands) const;

  Device& device() { return *device_; }
  Buffers& buffers() { return buffers_; }
  const Buffers& buffers() const { return buffers_; }
  // Of the last build() and prepare().
  const FrameArguments& arguments() const { return arguments_; }
  // Lights of the last prepare() that are neither empty nor beside the view.
  std::uint32_t lights_in_view() const { return lights_in_view_; }
  std::size_t host_bytes() const;

 private:
  struct Vec4 {
    float x, y, z, w;
  };
  struct Cone {
    Vec4 apex_range, axis_cosine, sine;
  };
  void reserve_boundaries(const grid::ScreenGrid& grid);
  void build_on_host(const grid::Grid& grid, const assign::LightKinds& kinds);
  void build_on_device(const assign::LightKinds& kinds);
  double run_build(const assign::DeviceRepeats& repeats);
  void pack_balls(const view::LightArrays& lights);
  void pack_cones(const view::LightArrays& lights);
  void pack_boxes(const view::LightArrays& lights);

  Device* device_;
  Buffers buffers_;
  assign::LightTest test_;
  bool is_built_on_device_, has_cell_balls_ = false;
  std::vector<float> boundaries_;  // of the last build(), where the device has them
  assign::DeviceRepeats repeats_;
  std::optional<assign::ViewCull> view_;
  std::uint32_t lights_in_view_ = 0;
  bool takes_boxes_ = false, takes_boundaries_ = false;
  FrameArguments arguments_;
  std::vector<Vec4> balls_;
  std::vector<Cone> cones_;
  std::vector<Vec4> boxes_;  // the least and the greatest corner of each
};

// The parameters of methods that take a grid's cells: those of light tests, and `cells`, where their bounds are made.
std::vector<assign::ParamSpec> device_params();
// The reason why no method can run here; "" if they can.
std::string no_device(const assign::Params& params);
// The same for a method with this shader.
std::string no_device_for(const char* shader, const assign::Params& params);

}  // namespace clusterbench::gpu
