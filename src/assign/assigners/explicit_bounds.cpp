// The cells of a frustum grid, each limited to the depths of its pixels; cells without pixels get no list.

#include "assign/occupied/occupied_method.h"

namespace clusterbench::assign {

extern const AssignerDescriptor explicit_bounds_descriptor;
const AssignerDescriptor explicit_bounds_descriptor{
    .name = "explicit",
    .summary =
        "the grid's cells cut down to the least and the greatest depth of their pixels; cells without pixels get no "
        "list",
    .source = "Olsson, Billeter, Assarsson 2012, Clustered Deferred and Forward Shading (explicit bounds)",
    .kinds = {grid::Kind::frustum},
    .needs = {.depth = true},
    .at_surfaces = true,
    .own_lists = true,
    .params = light_params(),
    .make_own = make_occupied<CellBounds::samples>,
};

}  // namespace clusterbench::assign
