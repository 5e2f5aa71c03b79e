// Every light against every cell's view-space bounding box: the method of a first compute shader, and the baseline.
// Boxes by their own axis-aligned bounds.

#include "assign/bounds/bounds_method.h"

namespace clusterbench::assign {
namespace {

struct EveryAabb : CellAabbs {
  static constexpr Candidates k_candidates = Candidates::all_cells;
};

}  // namespace

extern const AssignerDescriptor brute_force_descriptor;
const AssignerDescriptor brute_force_descriptor{
    .name = "brute-force",
    .summary = "every light against every cell's view-space bounding box",
    .source = "DaveH355, three.js",
    .kinds = {grid::Kind::frustum},
    .boxes = true,
    .all_pairs = true,
    .params = light_params(),
    .make = make_list_assigner<CellBoxMethod<EveryAabb, CoarseBoxTest>>,
};

}  // namespace clusterbench::assign
