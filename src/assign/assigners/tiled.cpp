// One list for each tile of the screen: the lights that reach it between the least and the greatest depth of its
// pixels.

#include "assign/occupied/occupied_method.h"

namespace clusterbench::assign {

extern const AssignerDescriptor tiled_descriptor;
const AssignerDescriptor tiled_descriptor{
    .name = "tiled",
    .summary =
        "one list per tile, of the lights between the least and the greatest depth of its pixels; takes a grid's "
        "tiles, its slices do not matter",
    .source = "Andersson 2009, Parallel Graphics in Frostbite; planes and boxes: Wicked Engine 2018",
    .kinds = {grid::Kind::frustum},
    .needs = {.depth = true},
    .at_surfaces = true,
    .own_lists = true,
    .params = tiled_params(),
    .make_own = make_occupied<CellBounds::tile>,
};

}  // namespace clusterbench::assign
