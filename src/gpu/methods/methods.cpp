#include "gpu/methods/methods.h"

#include <deque>

#include "gpu/methods/descriptors.h"

namespace clusterbench::gpu {

void register_methods() {
  static const auto registered = [] {  // in the order in which they are shown
    std::deque<assign::AssignerRegistration> all;
    all.emplace_back(gpu_cells_descriptor());
    all.emplace_back(gpu_cells_fixed_descriptor());
    all.emplace_back(gpu_group_descriptor());
    all.emplace_back(gpu_refined_descriptor());
    all.emplace_back(gpu_mask_descriptor());
    all.emplace_back(gpu_lights_descriptor());
    all.emplace_back(gpu_tiled_descriptor());
    return all;
  }();
}

}  // namespace clusterbench::gpu
