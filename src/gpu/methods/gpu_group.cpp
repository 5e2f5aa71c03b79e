// On the device: one group per block of 4 x 4 x 4 cells. Lights are tested against the block first, and those that
// touch it against its cells.
#include "gpu/methods/descriptors.h"
#include "gpu/methods/group_lists.h"

namespace clusterbench::gpu {
namespace {

class Group final : public GroupLists {
 public:
  explicit Group(const assign::Params& params) : GroupLists(params, CellTest::box) {}
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
