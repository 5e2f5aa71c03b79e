// Boxes against cells by axis-aligned bounds alone: the coarse test. Points and spots as in `aabb`.

#include "assign/bounds/bounds_method.h"

namespace clusterbench::assign {
extern const AssignerDescriptor box_bounds_descriptor;
const AssignerDescriptor box_bounds_descriptor{
    .name = "box-bounds",
    .summary = "boxes (decals, probes) by their axis-aligned bounds against each cell's; points and spots as aabb",
    .source = "Wicked Engine 2018, Optimizing tile-based light culling: the coarse test",
    .kinds = {grid::Kind::frustum},
    .boxes = true,
    .by_name = true,
    .params = light_params(),
    .make = make_list_assigner<CellBoxMethod<AabbsInExtents, CoarseBoxTest>>,
};

}  // namespace clusterbench::assign
