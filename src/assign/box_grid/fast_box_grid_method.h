#pragma once
// What the fast forms of `cascades` and `world-grid` share: level by level the ranges of boxes that balls reach are
// found a vector of balls at a time, then their lists are made slice by slice (bounds_lists.h). Every step gives what
// box_rows.h gives.

#include <memory>
#include <vector>

#include "assign/bounds/bounds_lists.h"
#include "assign/box_grid/box_levels.h"
#include "assign/box_grid/box_ranges.h"
#include "assign/cone/spot_spheres.h"
#include "assign/contract/assigner.h"
#include "assign/contract/light_test.h"

namespace clusterbench::assign {

class FastBoxGridMethod final : public ListAssigner {
 public:
  explicit FastBoxGridMethod(const Params& params) : test_(params, k_box_roundings), lists_(test_) {}

  void build(const grid::Grid& grid, const LightKinds& kinds) override {
    test_.start_grid(grid, kinds);
    lists_.start_grid(grid.cells(), "cells");
    levels_.clear();
    for (const BoxGrid& boxes : box_levels(grid)) levels_.emplace_back(boxes);
  }

  void assign(const FrameInput& input, Lists& out) override {
    const view::LightArrays& lights = input.lights;
    test_.start_frame(lights);
    lists_.start_frame(lights, out);
    boxed_.reserve(lights.size());
    if (lights.spots > 0) find_spot_balls(lights, test_.own_padding(), test_.balls_are_around_cones(), spots_);
    for (const Level& level : levels_) add_level(level, lights);
    lists_.finish();
  }

  std::uint64_t tests_done() const override { return lists_.tests_done(); }
  std::size_t scratch_bytes() const override {
    std::size_t bytes = lists_.capacity_bytes() + test_.capacity_bytes() + boxed_.capacity_bytes() +
                        lane_columns_.capacity_bytes() + spots_.capacity_bytes();
    for (const Level& level : levels_) bytes += level.axes.capacity_bytes() + level.cells.capacity_bytes();
    return bytes;
  }

 private:
  struct Level {
    RangeAxes axes;
    CellExtents cells;
    int slices;

    explicit Level(const BoxGrid& boxes) : axes(boxes), cells(boxes), slices(static_cast<int>(boxes.z.size())) {}
  };

  void add_level(const Level& level, const view::LightArrays& lights) {
    boxed_.count = 0;
    find_box_ranges(level.axes, given_points(lights), 0, test_.own_padding(), boxed_);
    if (lights.spots > 0) find_box_ranges(level.axes, given_spots(lights, spots_), lights.points, 0.0f, boxed_);
    const auto find = [&](const BallBatch& batch, BatchRows& rows) {
      find_box_rows(level.cells, batch, lane_columns_, rows);
    };
    // A hole begins at the first slice.
    lists_.add_slices(boxed_, level.slices, find, {level.axes.hole_y, level.axes.hole_x}, level.axes.hole_z.count());
  }

  LightTest test_;
  std::vector<Level> levels_;
  BallArrays spots_;
  BoxedBalls boxed_;
  LaneColumns lane_columns_;
  BoxedLists lists_;
};

inline std::unique_ptr<ListAssigner> make_fast_box_grid_method(const Params& params) {
  return std::make_unique<FastBoxGridMethod>(params);
}

}  // namespace clusterbench::assign
