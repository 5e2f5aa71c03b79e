// All cells within a light's analytic screen and depth extents: Persson's "cube", from which the finer methods remove
// cells.

#include "assign/bounds/bounds_method.h"

namespace clusterbench::assign {
namespace {

struct NoTest {
  static constexpr Candidates k_candidates = Candidates::untested_box;
  static constexpr float k_roundoffs = 0.0f;
  void build(const grid::Grid&) {}
  std::size_t capacity_bytes() const { return 0; }
};

}  // namespace

extern const AssignerDescriptor bounds_descriptor;
const AssignerDescriptor bounds_descriptor{
    .name = "bounds",
    .summary = "all cells within the light's analytic extents on the screen and in depth",
    .source =
        "Persson 2015, Practical Clustered Shading, made conservative: tangents rounded outward, slices without a "
        "logarithm",
    .kinds = {grid::Kind::frustum},
    .params = light_params(),
    .make = make_list_assigner<CellBoxMethod<NoTest>>,
};

}  // namespace clusterbench::assign
