// The cells of the light's extents for which none of the six planes has the whole ball outside. It cannot exclude a
// ball that passes a cell's edge or corner. A frustum cell's planes are the grid's, and the extents already use those
// planes, so within the extents it excludes almost nothing; the method shows the cost of this test.

#include "assign/bounds/bounds_method.h"

namespace clusterbench::assign {
namespace {

struct PlanesInExtents : CellPlanes {
  static constexpr Candidates k_candidates = Candidates::in_box;
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
