// On the device: one invocation per cell, over all lights; counted, summed, then written: the compute shader of
// tutorials, with lists of any length.
#include "gpu/methods/descriptors.h"
#include "gpu/methods/device_lists.h"

namespace clusterbench::gpu {
namespace {

class Cells final : public DeviceLists {
 public:
  explicit Cells(const assign::Params& params)
      : DeviceLists(params),
        count_(kernel("cells", k_group, Mode::count)),
        fill_(kernel("cells", k_group, Mode::fill)) {}

 private:
  static constexpr std::uint32_t k_group = 64;

  void record_counts(Commands& commands, const FrameArguments& arguments) override {
    commands.dispatch(count_, arguments, groups_for(arguments.cells, k_group));
  }
  void record_lists(Commands& commands, const FrameArguments& arguments) override {
    commands.dispatch(fill_, arguments, groups_for(arguments.cells, k_group));
  }
  std::uint64_t tests_of(const FrameArguments& arguments) const override {
    return std::uint64_t{arguments.cells} * arguments.lights;
  }

  Kernel count_, fill_;
};

}  // namespace

assign::AssignerDescriptor gpu_cells_descriptor() {
  return {
      .name = "gpu-cells",
      .summary = "on the GPU, an invocation per cell over all lights: counted, summed, written",
      .source =
          "Operation Black Mesa (an offset and a count per cell into one list); DaveH355, whose lists have a fixed "
          "length",
      .kinds = {grid::Kind::frustum},
      .all_pairs = true,
      .by_name = true,
      .on_device = true,
      .params = device_params(),
      .make = assign::make_list_assigner<Cells>,
      .unavailable = no_device,
  };
}

}  // namespace clusterbench::gpu
