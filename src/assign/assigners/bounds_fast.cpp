// Fast form of `bounds`: the same lists, with SIMD.

#include "assign/bounds/bounds_rows.h"
#include "assign/bounds/fast_bounds_method.h"

namespace clusterbench::assign {
namespace {

class AllRows {
 public:
  static constexpr float k_roundoffs = 0.0f;

  explicit AllRows(const Params&) {}

  void build(const grid::Grid& grid) { rows_ = grid.cells().y; }
  bool narrows() const { return false; }
  void narrow(CellBox&, const geom::SphericalCone&) const {}
  void find(const BallBatch& batch, BatchRows& out) const { find_bounds_rows(rows_, batch, out); }
  std::size_t capacity_bytes() const { return 0; }

 private:
  int rows_ = 0;
};

}  // namespace

extern const AssignerDescriptor bounds_fast_descriptor;
const AssignerDescriptor bounds_fast_descriptor{
    .name = "bounds-fast",
    .summary = "bounds, a vector of spheres at a time, lists by compression (SIMD, dispatched at run time)",
    .source =
        "Persson 2015, Practical Clustered Shading, made conservative: tangents rounded outward, slices without a "
        "logarithm",
    .kinds = {grid::Kind::frustum},
    .params = light_params(),
    .make = make_list_assigner<SliceBySlice<FrustumKernel<AllRows>>>,
};

}  // namespace clusterbench::assign
