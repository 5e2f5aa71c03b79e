// Nested view-space boxes: per level the index range of a light's box, then the squared distance per axis. Cells that
// lie in the finer level's box are skipped.

#include "assign/box_grid/box_grid_method.h"

namespace clusterbench::assign {

extern const AssignerDescriptor cascades_descriptor;
const AssignerDescriptor cascades_descriptor{
    .name = "cascades",
    .summary = "sphere against the cubical cells of nested view-space boxes, level by level",
    .source =
        "this project's method: squared distance per axis as in Arvo 1990; cascades of boxes in view space are an idea "
        "of Persson 2015",
    .kinds = {grid::Kind::cascades},
    .params = light_params(),
    .make = make_list_assigner<BoxGridMethod>,
};

}  // namespace clusterbench::assign
