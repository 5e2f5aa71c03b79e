// Boxes against cells in three tests: axis-aligned bounds in view space, the cell's bounds in the box's own space, and
// the cell's sides. Points and spots as in `aabb`.

#include "assign/bounds/bounds_method.h"

namespace clusterbench::assign {
namespace {

struct RefinedBoxTest : FrustumCells {
  // The largest of its three tests.
  static constexpr float k_roundoffs = geom::k_sides_roundoffs;

  bool touches(const geom::PaddedBox& box, const CellAabbs& cells, std::uint32_t cell) const {
    const geom::Box& bounds = cells.bounds(cell);
    return geom::bounds_touch(box, bounds) && geom::bounds_touch_in_box_space(box, bounds) &&
           geom::touches_sides(box, cells_[cell]);
  }
};
static_assert(geom::k_sides_roundoffs >= geom::k_bounds_roundoffs &&
              geom::k_sides_roundoffs >= geom::k_box_space_roundoffs);

}  // namespace

extern const AssignerDescriptor box_refined_descriptor;
const AssignerDescriptor box_refined_descriptor{
    .name = "box-refined",
    .summary =
        "boxes by bounds in view space, by the cell's bounds in the box's own space, and by the cell's sides; points "
        "and spots as aabb",
    .source = "Wicked Engine 2018, Optimizing tile-based light culling: decals and environment probes",
    .kinds = {grid::Kind::frustum},
    .boxes = true,
    .by_name = true,
    .params = light_params(),
    .make = make_list_assigner<CellBoxMethod<AabbsInExtents, RefinedBoxTest>>,
};

}  // namespace clusterbench::assign
