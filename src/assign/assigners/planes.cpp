// The cells of the light's extents whose six planes each leave a part of the ball inside. Boxy: it cannot exclude a
// ball that passes a cell's edge or corner. A frustum cell's planes are the grid's, and the extents are what those
// planes leave, so within the extents it excludes next to nothing; it stands here to show what it costs.

#include "assign/cell_box_method.h"

namespace clusterbench::assign {
namespace {

struct PlanesInExtents : CellPlanes {
  static constexpr bool k_whole_grid = false;
};

}  // namespace

extern const AssignerRow planes_row;
const AssignerRow planes_row{
    .name = "planes",
    .summary = "the cells of the light's extents that none of their six planes excludes",
    .source = "Wicked Engine, and most tiled renderers",
    .kinds = {grid::Kind::frustum},
    .params = light_params(),
    .make = make_cell_box_method<PlanesInExtents>,
};

}  // namespace clusterbench::assign
