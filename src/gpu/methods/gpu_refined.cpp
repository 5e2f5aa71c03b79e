// On the device: as gpu-group, and each light whose ball touches the box around a cell is then tested against the cell
// itself.
#include "gpu/methods/descriptors.h"
#include "gpu/methods/group_lists.h"

namespace clusterbench::gpu {
namespace {

class Refined final : public GroupLists {
 public:
  explicit Refined(const assign::Params& params) : GroupLists(params, CellTest::cell) {}
};

}  // namespace

assign::AssignerDescriptor gpu_refined_descriptor() {
  return {
      .name = "gpu-refined",
      .summary =
          "on the GPU, as gpu-group; lights that touch the box around a cell are then tested against the cell itself: "
          "of points nearly exact lists",
      .source =
          "a separating direction from the cell's nearest point: Gilbert, Johnson, Keerthi 1988; here in closed form, "
          "and certain in single precision",
      .kinds = {grid::Kind::frustum},
      .by_name = true,
      .on_device = true,
      .params = device_params(),
      .make = assign::make_list_assigner<Refined>,
      .unavailable = no_device,
  };
}

}  // namespace clusterbench::gpu
