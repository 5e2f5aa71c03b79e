// On the device: one group per block of 4 x 4 x 4 cells. Lights are tested against the block first, and those that
// touch it against its cells.
#include "gpu/methods/descriptors.h"
#include "gpu/methods/device_lists.h"

namespace clusterbench::gpu {
namespace {

class Group final : public DeviceLists {
 public:
  explicit Group(const assign::Params& params)
      : DeviceLists(params),
        count_(kernel("group", k_block_cells, Mode::count)),
        fill_(kernel("group", k_block_cells, Mode::fill)) {}

 private:
  static constexpr std::uint32_t k_block_cells = 64;

  static std::uint64_t blocks_of(const FrameArguments& arguments) {
    return groups_for(arguments.columns, 4) * groups_for(arguments.rows, 4) * groups_for(arguments.slices, 4);
  }
  void record_counts(Commands& commands, const FrameArguments& arguments) override {
    commands.dispatch(count_, arguments, blocks_of(arguments));
  }
  void record_lists(Commands& commands, const FrameArguments& arguments) override {
    commands.dispatch(fill_, arguments, blocks_of(arguments));
  }
  std::uint64_t tests_of(const FrameArguments& arguments) const override {  // of the blocks
    return blocks_of(arguments) * arguments.lights;
  }

  Kernel count_, fill_;
};

}  // namespace

assign::AssignerDescriptor gpu_group_descriptor() {
  return {
      .name = "gpu-group",
      .summary = "on the GPU, a group per 64 cells: lights in shared batches, against the block of cells first",
      .source =
          "Ortiz 2018, A Primer On Efficient Rendering Algorithms & Clustered Shading (lights in shared batches); a "
          "coarse pass first: Wicked Engine 2018, Optimizing tile-based light culling",
      .kinds = {grid::Kind::frustum},
      .by_name = true,
      .on_device = true,
      .params = device_params(),
      .make = assign::make_list_assigner<Group>,
      .unavailable = no_device,
  };
}

}  // namespace clusterbench::gpu
