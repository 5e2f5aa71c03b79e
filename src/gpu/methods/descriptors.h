#pragma once
// The descriptor of each method, from its file.

#include "assign/contract/assigner.h"

namespace clusterbench::gpu {

assign::AssignerDescriptor gpu_cells_descriptor();
assign::AssignerDescriptor gpu_cells_fixed_descriptor();
assign::AssignerDescriptor gpu_group_descriptor();
assign::AssignerDescriptor gpu_refined_descriptor();
assign::AssignerDescriptor gpu_mask_descriptor();
assign::AssignerDescriptor gpu_lights_descriptor();
assign::AssignerDescriptor gpu_tiled_descriptor();

}  // namespace clusterbench::gpu
