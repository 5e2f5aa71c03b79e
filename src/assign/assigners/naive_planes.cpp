// Every light against the six planes of every cell, and nothing else: loses nothing, but takes every cell near whose
// edges and corners a large ball passes.

#include "assign/bounds/bounds_method.h"

namespace clusterbench::assign {
namespace {

struct PlanesEverywhere : CellPlanes {
  static constexpr Looks k_looks = Looks::everywhere;
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
