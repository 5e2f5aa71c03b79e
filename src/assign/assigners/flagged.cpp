// The cells of a frustum grid that contain pixels; the others get no list.

#include "assign/occupied/occupied_method.h"

namespace clusterbench::assign {

extern const AssignerDescriptor flagged_descriptor;
const AssignerDescriptor flagged_descriptor{
    .name = "flagged",
    .summary =
        "the grid's cells that hold pixels (flagged in a pass over the depth buffer), by extents and box as aabb; "
        "others get no list",
    .source = "Olsson, Billeter, Assarsson 2012, Clustered Deferred and Forward Shading; Persson 2015",
    .kinds = {grid::Kind::frustum},
    .needs = {.depth = true},
    .at_surfaces = true,
    .own_lists = true,
    .params = light_params(),
    .make_own = make_occupied<CellBounds::cell>,
};

}  // namespace clusterbench::assign
