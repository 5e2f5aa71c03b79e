// On the device: an invocation per cell and light; ballots make a bit for each pair, and lists are made of the bits.
#include "gpu/methods/descriptors.h"
#include "gpu/methods/device_lists.h"

namespace clusterbench::gpu {
namespace {

class Mask final : public MaskLists {
 public:
  explicit Mask(const assign::Params& params) : MaskLists(params), masks_(kernel("mask", k_group)) {}

 private:
  static constexpr std::uint32_t k_group = 64;  // lights at a time

  void record_masks(Commands& commands, const FrameArguments& arguments) override {
    commands.dispatch(masks_, arguments, arguments.cells * groups_for(arguments.words, k_group / 32));
  }
  std::uint64_t tests_of(const FrameArguments& arguments) const override {
    return std::uint64_t{arguments.cells} * arguments.lights;
  }

  Kernel masks_;
};

}  // namespace

assign::AssignerDescriptor gpu_mask_descriptor() {
  return {
      .name = "gpu-mask",
      .summary = "on the GPU, an invocation per cell and light: bits by ballot, lists from the bits",
      .source = "Granite (a ballot for 32 lights and a tile); bits of tiles without ballots: Wicked Engine",
      .kinds = {grid::Kind::frustum},
      .all_pairs = true,
      .by_name = true,
      .on_device = true,
      .params = device_params(),
      .make = assign::make_list_assigner<Mask>,
      .unavailable = [](const assign::Params& params) { return no_device_for("mask", params); },
  };
}

}  // namespace clusterbench::gpu
