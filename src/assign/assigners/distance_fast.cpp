// Fast form of `distance`: the same lists, with SIMD.

#include "assign/distance/shell_rows.h"
#include "assign/distance/shells.h"
#include "assign/pipeline/slice_by_slice.h"

namespace clusterbench::assign {
namespace {

class ShellKernel {
 public:
  static constexpr float k_roundoffs = k_shell_roundoffs;
  static constexpr const char* k_columns_key = "tiles";

  explicit ShellKernel(const Params&) {}

  void build(const grid::Grid& grid) { planes_ = ShellPlanes(grid.screen()); }
  int levels() const { return 1; }
  Level level(int) const { return {planes_.boundaries.slices()}; }

  void bound(int, const KernelLights& lights, BoundedBalls& out) const {
    find_shells(planes_, given_points(lights.all), lights.test.own_padding(), out);
    if (!lights.all.spots.empty()) find_shells(planes_, given_spots(lights.all, lights.spots), 0.0f, out);
  }
  void find_rows(int, const BallBatch& batch, BatchRows& out) const { find_shell_rows(planes_, batch, out); }

  std::size_t capacity_bytes() const { return planes_.capacity_bytes(); }

 private:
  ShellPlanes planes_;
};

}  // namespace

extern const AssignerDescriptor distance_fast_descriptor;
const AssignerDescriptor distance_fast_descriptor{
    .name = "distance-fast",
    .summary = "distance, one sphere per lane, lists by compression (SIMD, dispatched at run time)",
    .source = "this project: the closed form of a sphere's cap; shells of distance are an idea of Persson 2015",
    .kinds = {grid::Kind::distance},
    .orthographic = false,
    .params = light_params(),
    .make = make_list_assigner<SliceBySlice<ShellKernel>>,
};

}  // namespace clusterbench::assign
