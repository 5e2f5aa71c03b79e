// Every light against the six planes of every cell, and no other test: loses no lights, but lists every cell whose
// edges and corners a large ball passes nearby.

#include "assign/bounds/bounds_method.h"

namespace clusterbench::assign {
namespace {

struct PlanesEverywhere : CellPlanes {
  static constexpr Candidates k_candidates = Candidates::all_cells;
};

}  // namespace

extern const AssignerDescriptor naive_planes_descriptor;
const AssignerDescriptor naive_planes_descriptor{
    .name = "naive-planes",
    .summary = "every light against the six planes of every cell, without extents",
    .source = "many tiled renderers",
    .kinds = {grid::Kind::frustum},
    .naive = true,
    .params = light_params(),
    .make = make_list_assigner<CellBoxMethod<PlanesEverywhere>>,
};

}  // namespace clusterbench::assign
