// Fast form of `cascades`: the same lists, with SIMD.

#include "assign/box_grid/fast_box_grid_method.h"

namespace clusterbench::assign {

extern const AssignerDescriptor cascades_fast_descriptor;
const AssignerDescriptor cascades_fast_descriptor{
    .name = "cascades-fast",
    .summary = "cascades, one sphere per lane, lists by compression (SIMD, dispatched at run time)",
    .source =
        "this project's method: squared distance per axis as in Arvo 1990; cascades of boxes in view space are an idea "
        "of Persson 2015",
    .kinds = {grid::Kind::cascades},
    .params = light_params(),
    .make = make_list_assigner<SliceBySlice<BoxGridKernel>>,
};

}  // namespace clusterbench::assign
