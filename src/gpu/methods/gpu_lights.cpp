// On the device: a group per light, which scatters bits into the cells of the rows and columns that it reaches.
#include "gpu/methods/descriptors.h"
#include "gpu/methods/device_lists.h"

namespace clusterbench::gpu {
namespace {

class Lights final : public MaskLists {
 public:
  explicit Lights(const assign::Params& params) : MaskLists(params), scatter_(kernel("lights", k_group)) {}

 private:
  static constexpr std::uint32_t k_group = 64;

  void record_masks(Commands& commands, const FrameArguments& arguments) override {
    commands.fill(Binding::masks, 0, mask_bytes(arguments));
    commands.barrier();
    commands.dispatch(scatter_, arguments, arguments.lights);
  }
  std::uint64_t tests_of(const FrameArguments& arguments) const override {  // of the slices
    return std::uint64_t{arguments.slices} * arguments.lights;
  }

  Kernel scatter_;
};

}  // namespace

assign::AssignerDescriptor gpu_lights_descriptor() {
  return {
      .name = "gpu-lights",
      .summary =
          "on the GPU, a group per light: bits scattered into the cells of its rectangle in each slice, lists from the "
          "bits",
      .source =
          "Bevy 0.19 (on the GPU: slice by slice, inside the light's rectangle, by a rasteriser; its lists are "
          "counted, summed and written); bits: Godot 4",
      .kinds = {grid::Kind::frustum},
      .by_name = true,
      .on_device = true,
      .params = device_params(),
      .make = assign::make_list_assigner<Lights>,
      .unavailable = no_device,
  };
}

}  // namespace clusterbench::gpu
