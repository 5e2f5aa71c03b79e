#pragma once
// The driver of the vector methods: cull, bin by slice, columns of rows, lists. A kernel finds the balls that have
// cells, and the columns that they touch in a row; the rest is the same for frustum, distance, cascade and world grids.

#include "assign/cone/bounding_spheres.h"
#include "assign/contract/assigner.h"
#include "assign/contract/light_test.h"
#include "assign/pipeline/bounded_balls.h"
#include "assign/pipeline/slice_lists.h"

namespace clusterbench::assign {

// A frame's lights, as a kernel needs them to find their balls.
struct KernelLights {
  const view::LightArrays& all;
  const LightTest& test;
  const BallArrays& spots;  // the spots' balls with the method's padding; empty without spots
};

// Kernel:
//   k_roundoffs, the error of its own steps, and k_columns_key, the configuration key for the number of columns,
//   Kernel(const Params&), build(const grid::Grid&), capacity_bytes() const,
//   levels() const -> int and level(int) const -> Level; levels follow one another in the order of the cells,
//   bound(int level, const KernelLights&, BoundedBalls&): appends the balls that have cells there, ascending by light,
//   find_rows(int level, const BallBatch&, BatchRows&).
template <class Kernel>
class SliceBySlice final : public ListAssigner {
 public:
  explicit SliceBySlice(const Params& params) : test_(params, Kernel::k_roundoffs), kernel_(params), lists_(test_) {}

  void build(const grid::Grid& grid, const LightKinds& kinds) override {
    test_.start_grid(grid, kinds);
    lists_.start_grid(grid.cells(), Kernel::k_columns_key);
    kernel_.build(grid);
  }

  void assign(const FrameInput& input, Lists& out) override {
    const view::LightArrays& lights = input.lights;
    test_.start_frame(lights);
    bounded_.reserve(lights.size());
    if (!lights.spots.empty()) find_spot_balls(lights, test_.own_padding(), test_.balls_are_around_cones(), spots_);
    lists_.start_frame(lights, out);
    for (int level = 0; level < kernel_.levels(); ++level) {
      bounded_.count = 0;
      kernel_.bound(level, {lights, test_, spots_}, bounded_);
      lists_.add_slices(bounded_, kernel_.level(level),
                        [&](const BallBatch& batch, BatchRows& rows) { kernel_.find_rows(level, batch, rows); });
    }
    lists_.finish();
  }

  std::uint64_t tests_done() const override { return lists_.tests_done(); }
  EarlierFrames earlier_frames() const override { return EarlierFrames::matter_to_scratch; }
  std::size_t scratch_bytes() const override {
    return lists_.capacity_bytes() + test_.capacity_bytes() + bounded_.capacity_bytes() + spots_.capacity_bytes() +
           kernel_.capacity_bytes();
  }

 private:
  LightTest test_;
  Kernel kernel_;
  BallArrays spots_;
  BoundedBalls bounded_;
  SliceLists lists_;
};

}  // namespace clusterbench::assign
