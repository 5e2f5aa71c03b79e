// Like tiled; in addition each tile has a bit for each of 32 parts of its range of depth, set if a pixel lies in that
// part. A light whose own bits meet none of them is left out.

#include "assign/occupied/occupied_method.h"

namespace clusterbench::assign {

extern const AssignerDescriptor tiled_2_5d_descriptor;
const AssignerDescriptor tiled_2_5d_descriptor{
    .name = "tiled-2.5d",
    .summary =
        "tiled, and a mask of 32 parts of each tile's range of depth: a light is listed where it reaches a part with "
        "pixels",
    .source = "Harada 2012, A 2.5D Culling for Forward+; Wicked Engine 2018",
    .kinds = {grid::Kind::frustum},
    .needs = {.depth = true},
    .at_surfaces = true,
    .own_lists = true,
    .params = tiled_params(),
    .make_own = make_occupied<CellBounds::masked_tile>,
};

}  // namespace clusterbench::assign
