// The world's box grid: light positions are relative to its origin, along the world's axes.

#include "assign/box_grid/box_grid_method.h"

namespace clusterbench::assign {

extern const AssignerDescriptor world_grid_descriptor;
const AssignerDescriptor world_grid_descriptor{
    .name = "world-grid",
    .summary = "sphere against the boxes of a fixed world grid, row by row",
    .source =
        "PlayCanvas clustered lighting, which lists a light's box in a grid over the frame's lights; here spheres and "
        "cones are tested, in a grid that stays",
    .kinds = {grid::Kind::world},
    .params = light_params(),
    .make = make_list_assigner<BoxGridMethod>,
};

}  // namespace clusterbench::assign
