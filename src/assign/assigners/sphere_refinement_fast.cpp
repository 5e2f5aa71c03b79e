// Fast form of `sphere-refinement`: the same lists, with SIMD.

#include "assign/bounds/bounds_rows.h"
#include "assign/bounds/fast_bounds_method.h"
#include "assign/bounds/refinement.h"

namespace clusterbench::assign {
namespace {

class RefinedRows {
 public:
  static constexpr float k_roundoffs = k_refinement_roundoffs;

  explicit RefinedRows(const Params& params) : narrowing_(assign::narrows(params)) {}

  void build(const grid::Grid& grid) { planes_ = RefinementPlanes(grid.screen()); }
  bool narrows() const { return narrowing_; }
  void narrow(CellBox& box, const geom::SphericalCone& cone) const {
    narrow_from_six_sides(box, cone, planes_.depths, planes_.columns, planes_.rows);
  }
  void find(const BallBatch& batch, BatchRows& out) { find_refined_rows(planes_, batch, lane_columns_, out); }
  std::size_t capacity_bytes() const { return planes_.capacity_bytes() + lane_columns_.capacity_bytes(); }

 private:
  bool narrowing_;
  RefinementPlanes planes_;
  LaneColumns lane_columns_;
};

}  // namespace

extern const AssignerDescriptor sphere_refinement_fast_descriptor;
const AssignerDescriptor sphere_refinement_fast_descriptor{
    .name = "sphere-refinement-fast",
    .summary = "sphere-refinement, one sphere per lane, lists by compression (SIMD, dispatched at run time)",
    .source =
        "Persson 2015, Practical Clustered Shading, made conservative: sides are taken again after each cut, by both "
        "planes of a row and a column, without a logarithm (Filament takes row and column again per slice, Bevy its "
        "centre row once)",
    .kinds = {grid::Kind::frustum},
    .params = refinement_params(),
    .make = make_list_assigner<SliceBySlice<FrustumKernel<RefinedRows>>>,
};

}  // namespace clusterbench::assign
