// Tile masks and depth ranges as in Babylon.js, without its mistakes: points and spots in one order by depth, spots as
// the balls of their ranges, and the tiles of the box around a ball's outline.

#include "assign/bounds/cell_bounds.h"
#include "assign/contract/light_test.h"
#include "assign/depth_bins/babylon_order.h"
#include "core/arrays.h"

namespace clusterbench::assign {
namespace {

class BabylonMasks final : public AssignerOf<SortedMasks<RangesOf::slices>> {
 public:
  explicit BabylonMasks(const Params& params)
      : padding_(static_cast<float>(params.number("inflation")) * (view::k_given_roundoffs + k_cell_box_roundoffs)) {}

  void build(const grid::Grid& grid, const LightKinds&) override { grid_ = &grid; }

  std::uint64_t tests_done() const override { return order_.size(); }
  std::size_t scratch_bytes() const override { return bytes_of(order_); }

 protected:
  // A ball that reaches no cell has neither tiles nor slices.
  void fill(const FrameInput& input, SortedMasks<RangesOf::slices>& out) override {
    fill_in_one_order(*grid_, input.lights, order_, out, [&](std::uint32_t light) {
      const CellBox box = cell_box(*grid_, input.lights.ball(light, padding_));
      return box.empty() ? CellBox{{0, 0, 0}, {-1, -1, -1}} : box;
    });
  }

 private:
  float padding_;
  const grid::Grid* grid_ = nullptr;
  std::vector<std::uint32_t> order_;
};

}  // namespace

extern const AssignerDescriptor babylon_masks_descriptor;
const AssignerDescriptor babylon_masks_descriptor{
    .name = "babylon-masks",
    .summary =
        "masks of tiles and ranges of slices as z-binning has them, of points and spots in one order by depth; spots "
        "are the spheres of their ranges",
    .source = "Babylon.js, clustered light container (9.35)",
    .kinds = {grid::Kind::frustum},
    .by_name = true,
    .params = {inflation_param()},
    .make_own = make_structure_assigner<BabylonMasks>,
};

}  // namespace clusterbench::assign
