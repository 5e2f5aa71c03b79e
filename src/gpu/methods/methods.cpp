#include "gpu/methods/methods.h"

#include <deque>

namespace clusterbench::gpu {

// Each from its file, in the order in which they are shown.
assign::AssignerDescriptor gpu_cells_descriptor();
assign::AssignerDescriptor gpu_cells_fixed_descriptor();
assign::AssignerDescriptor gpu_group_descriptor();
assign::AssignerDescriptor gpu_mask_descriptor();
assign::AssignerDescriptor gpu_lights_descriptor();
assign::AssignerDescriptor gpu_tiled_descriptor();

void register_methods() {
  static const auto registered = [] {
    std::deque<assign::AssignerRegistration> all;
    all.emplace_back(gpu_cells_descriptor());
    all.emplace_back(gpu_cells_fixed_descriptor());
    all.emplace_back(gpu_group_descriptor());
    all.emplace_back(gpu_mask_descriptor());
    all.emplace_back(gpu_lights_descriptor());
    all.emplace_back(gpu_tiled_descriptor());
    return all;
  }();
}

}  // namespace clusterbench::gpu
