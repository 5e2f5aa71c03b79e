// Fast form of `aabb`: the same lists, with SIMD.

#include "assign/bounds/bounds_method.h"
#include "assign/bounds/bounds_rows.h"
#include "assign/bounds/fast_bounds_method.h"

namespace clusterbench::assign {
namespace {

class RowsByBoxes {
 public:
  static constexpr float k_roundoffs = CellAabbs::k_roundoffs;

  explicit RowsByBoxes(const Params&) {}

  void build(const grid::Grid& grid) { cells_ = cell_extents(grid); }
  bool narrows() const { return false; }
  void narrow(CellBox&, const geom::SphericalCone&) const {}
  void find(const BallBatch& batch, BatchRows& out) { find_box_rows(cells_, batch, lane_columns_, out); }
  std::size_t capacity_bytes() const { return cells_.capacity_bytes() + lane_columns_.capacity_bytes(); }

 private:
  CellExtents cells_;
  LaneColumns lane_columns_;
};

}  // namespace

extern const AssignerDescriptor aabb_fast_descriptor;
const AssignerDescriptor aabb_fast_descriptor{
    .name = "aabb-fast",
    .summary =
        "aabb with gaps that rows share, one sphere per lane, lists by compression (SIMD, dispatched at run time)",
    .source = "Persson 2015, Practical Clustered Shading; DaveH355's test, which visits every cell",
    .kinds = {grid::Kind::frustum},
    .params = light_params(),
    .make = make_list_assigner<SliceBySlice<FrustumKernel<RowsByBoxes>>>,
};

}  // namespace clusterbench::assign
