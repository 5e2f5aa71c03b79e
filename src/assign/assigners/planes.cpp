// The cells of the light's extents whose six planes each leave a part of the ball inside. Boxy: it cannot exclude a
// ball that passes a cell's edge or corner. A frustum cell's planes are the grid's, and the extents are what those
// planes leave, so within the extents it excludes next to nothing; it stands here to show what it costs.

#include "assign/bounds/bounds_method.h"

namespace clusterbench::assign {
namespace {

struct PlanesInExtents : CellPlanes {
  static constexpr Looks k_looks = Looks::in_box;
};

}  // namespace

extern const AssignerDescriptor planes_descriptor;
const AssignerDescriptor planes_descriptor{
    .name = "planes",
    .summary = "the cells of the light's extents that none of their six planes excludes",
    .source = "the test of Wicked Engine and most tiled renderers, which make it for every light and tile",
    .kinds = {grid::Kind::frustum},
    .params = light_params(),
    .make = make_list_assigner<CellBoxMethod<PlanesInExtents>>,
};

}  // namespace clusterbench::assign
