// Like `z-binning`, but every tile has its own first and last light of each slice.

#include "assign/depth_bins/sorted_masks.h"

namespace clusterbench::assign {

extern const AssignerDescriptor tile_ranges_descriptor;
const AssignerDescriptor tile_ranges_descriptor{
    .name = "tile-ranges",
    .summary =
        "lights sorted by depth, bit masks per tile, and for each tile and slice the first and last index; a sample "
        "loops over its tile's bits within its own range",
    .source = "Godot 4, clustered forward renderer (tiles with 32 linear slices)",
    .kinds = {grid::Kind::frustum},
    .by_name = true,
    .params = {inflation_param()},
    .make_own = make_structure_assigner<SortedMasksMethod<RangesOf::cells>>,
};

}  // namespace clusterbench::assign
