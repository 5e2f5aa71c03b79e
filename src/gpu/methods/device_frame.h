#pragma once
// The input of all methods, on the device: the bounds of a grid's cells, and the lights of a frame as balls and cones,
// padded by the error of the shaders' tests.

#include <optional>
#include <vector>

#include "assign/contract/light_test.h"
#include "gpu/methods/frame_arguments.h"

namespace clusterbench::gpu {

class DeviceFrame {
 public:
  explicit DeviceFrame(const assign::Params& params);

  // Uploads the bounds of a frustum grid's cells, and the balls around them if cones are tested.
  void build(const grid::Grid& grid, const assign::LightKinds& kinds);
  // Packs a frame's lights, and makes room for them. Before commands are recorded, as all that makes room.
  void prepare(const view::LightArrays& lights);
  // Records the upload of the lights of the last prepare(), and the barrier behind it.
  void upload(Commands& commands) const;

  Device& device() { return *device_; }
  Buffers& buffers() { return buffers_; }
  const Buffers& buffers() const { return buffers_; }
  // Of the last build() and prepare().
  const FrameArguments& arguments() const { return arguments_; }
  std::size_t host_bytes() const;

 private:
  struct Vec4 {
    float x, y, z, w;
  };
  struct Cone {
    Vec4 apex_range, axis_cosine, sine;
  };
  void pack_balls(const view::LightArrays& lights);
  void pack_cones(const view::LightArrays& lights);

  Device* device_;
  Buffers buffers_;
  assign::LightTest test_;
  FrameArguments arguments_;
  std::vector<Vec4> balls_;
  std::vector<Cone> cones_;
};

// The parameters of every method: those of light tests.
std::vector<assign::ParamSpec> device_params();
// The reason why no method can run here; "" if they can.
std::string no_device(const assign::Params& params);

}  // namespace clusterbench::gpu
