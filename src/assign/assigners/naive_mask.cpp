// tiled-2.5d with a mistake that was shipped: the parts of a tile's depth are clamped to 32, but 31 is the last of the
// 32 parts.

#include "assign/occupied/occupied_method.h"

namespace clusterbench::assign {
namespace {

std::unique_ptr<StructureAssigner> make_with_part_32(const Params& params) {
  return std::make_unique<OccupiedMethod>(params, CellBounds::masked_tile, EndOfParts::part_32);
}

}  // namespace

extern const AssignerDescriptor naive_mask_descriptor;
const AssignerDescriptor naive_mask_descriptor{
    .name = "naive-mask",
    .summary =
        "tiled-2.5d whose farthest pixel is in a part 32, which has no bit: the shift makes it bit 0, and a light that "
        "reaches that pixel alone is lost",
    .source = "Wicked Engine 2018, Optimizing tile-based light culling",
    .kinds = {grid::Kind::frustum},
    .needs = {.depth = true},
    .conservative = false,
    .at_surfaces = true,
    .own_lists = true,
    .naive = true,
    .params = tiled_params(),
    .make_own = make_with_part_32,
};

}  // namespace clusterbench::assign
