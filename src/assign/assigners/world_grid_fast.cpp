// Fast form of `world-grid`: the same lists, with SIMD.

#include "assign/box_grid/fast_box_grid_method.h"

namespace clusterbench::assign {

extern const AssignerDescriptor world_grid_fast_descriptor;
const AssignerDescriptor world_grid_fast_descriptor{
    .name = "world-grid-fast",
    .summary = "world-grid, one sphere per lane, lists by compression (SIMD, dispatched at run time)",
    .source =
        "PlayCanvas clustered lighting, which lists a light's box in a grid over the frame's lights; here spheres and "
        "cones are tested, in a grid that stays",
    .kinds = {grid::Kind::world},
    .params = light_params(),
    .make = make_list_assigner<SliceBySlice<BoxGridKernel>>,
};

}  // namespace clusterbench::assign
