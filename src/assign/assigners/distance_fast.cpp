// `distance` for speed: the same lists, SIMD.

#include <memory>

#include "assign/bounds/bounds_lists.h"
#include "assign/cone/spot_spheres.h"
#include "assign/contract/assigner.h"
#include "assign/contract/light_test.h"
#include "assign/rows/shell_rows.h"
#include "assign/rows/shells.h"

namespace clusterbench::assign {
namespace {

class DistanceFast final : public ListAssigner {
 public:
  explicit DistanceFast(const Params& params) : test_(params, k_shell_roundings), lists_(test_) {}

  void build(const grid::Grid& grid, const LightKinds& kinds) override {
    test_.start_grid(grid, kinds);
    lists_.start_grid(grid.cells(), "tiles");
    planes_ = ShellPlanes(grid.screen());
    shells_ = grid.cells().z;
  }

  void assign(const FrameInput& input, Lists& out) override {
    const view::LightArrays& lights = input.lights;
    test_.start_frame(lights);
    boxed_.count = 0;
    boxed_.reserve(lights.size());
    find_shells(planes_, given_points(lights), 0, test_.own_padding(), boxed_);
    if (lights.spots > 0) {
      find_spot_balls(lights, test_.own_padding(), test_.balls_are_around_cones(), spots_);
      find_shells(planes_, given_spots(lights, spots_), lights.points, 0.0f, boxed_);
    }
    lists_.start_frame(lights, out);
    lists_.add_slices(boxed_, shells_,
                      [&](const BallBatch& batch, BatchRows& rows) { find_shell_rows(planes_, batch, rows); });
    lists_.finish();
  }

  std::uint64_t tests_done() const override { return lists_.tests_done(); }
  std::size_t scratch_bytes() const override {
    return lists_.capacity_bytes() + test_.capacity_bytes() + boxed_.capacity_bytes() + spots_.capacity_bytes() +
           planes_.capacity_bytes();
  }

 private:
  LightTest test_;
  ShellPlanes planes_;
  int shells_ = 0;
  BallArrays spots_;
  BoxedBalls boxed_;
  BoxedLists lists_;
};

std::unique_ptr<ListAssigner> make(const Params& params) {
  return std::make_unique<DistanceFast>(params);
}

}  // namespace

extern const AssignerDescriptor distance_fast_descriptor;
const AssignerDescriptor distance_fast_descriptor{
    .name = "distance-fast",
    .summary = "distance, one ball per lane, lists by compression (SIMD, dispatched at run time)",
    .source = "this project: the closed form of a ball's cap; shells of distance are an idea of Persson 2015",
    .kinds = {grid::Kind::distance},
    .orthographic = false,
    .params = light_params(),
    .make = make,
};

}  // namespace clusterbench::assign
