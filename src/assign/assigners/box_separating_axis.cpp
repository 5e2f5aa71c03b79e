// Boxes against the frustum cells themselves by the separating-axis test. Points and spots as in `aabb`.

#include "assign/bounds/bounds_method.h"

namespace clusterbench::assign {
namespace {

struct SeparatingAxisTest : FrustumCells {
  static constexpr float k_roundoffs = geom::k_separating_axis_roundoffs;

  bool touches(const geom::PaddedBox& box, const CellAabbs& cells, std::uint32_t cell) const {
    return geom::bounds_touch(box, cells.bounds(cell)) && geom::no_axis_separates(box, cells_[cell]);
  }
};
static_assert(geom::k_separating_axis_roundoffs >= geom::k_bounds_roundoffs);

}  // namespace

extern const AssignerDescriptor box_separating_axis_descriptor;
const AssignerDescriptor box_separating_axis_descriptor{
    .name = "box-separating-axis",
    .summary = "boxes by the separating-axis test against the frustum cell itself; points and spots as aabb",
    .source = "Gottschalk, Lin and Manocha 1996, OBBTree; box tests as in Wicked Engine and Unreal",
    .kinds = {grid::Kind::frustum},
    .boxes = true,
    .by_name = true,
    .params = light_params(),
    .make = make_list_assigner<CellBoxMethod<AabbsInExtents, SeparatingAxisTest>>,
};

}  // namespace clusterbench::assign
