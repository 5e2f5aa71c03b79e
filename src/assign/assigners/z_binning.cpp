// Lights sorted by depth; each depth bin has the first and the last light that reach it; each tile of the screen has
// one bit per light. Bins are the grid's slices.

#include "assign/depth_bins/sorted_masks.h"

namespace clusterbench::assign {

extern const AssignerDescriptor z_binning_descriptor;
const AssignerDescriptor z_binning_descriptor{
    .name = "z-binning",
    .summary =
        "lights sorted by depth: the first and last index per depth bin, bit masks per tile; a sample loops over "
        "its tile's bits within its bin's range",
    .source = "Drobot 2017, Improved Culling for Tiled and Clustered Rendering; Unity's URP",
    .kinds = {grid::Kind::frustum},
    .params = {inflation_param()},
    .make_own = make_structure_assigner<SortedMasksMethod<RangesOf::slices>>,
};

}  // namespace clusterbench::assign
