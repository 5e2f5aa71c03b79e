#pragma once
// The common part of the fast forms of `cascades` and `world-grid`: the kernel of slice_by_slice.h for grids of boxes.
// Level by level the ranges of boxes that balls reach are found a vector of balls at a time. Every step has the same
// result as in box_rows.h.

#include <vector>

#include "assign/bounds/bounds_rows.h"
#include "assign/box_grid/box_levels.h"
#include "assign/box_grid/box_ranges.h"
#include "assign/pipeline/slice_by_slice.h"

namespace clusterbench::assign {

class BoxGridKernel {
 public:
  static constexpr float k_roundoffs = k_box_roundoffs;
  static constexpr const char* k_columns_key = "cells";

  explicit BoxGridKernel(const Params&) {}

  void build(const grid::Grid& grid) {
    levels_.clear();
    for (const BoxGrid& boxes : box_levels(grid)) levels_.emplace_back(boxes);
  }
  int levels() const { return static_cast<int>(levels_.size()); }
  Level level(int index) const {
    const BoxLevel& boxes = at(index);
    // A hole begins at the first slice.
    return {boxes.slices, {boxes.axes.hole_y, boxes.axes.hole_x}, boxes.axes.hole_z.count()};
  }

  void bound(int level, const KernelLights& lights, BoundedBalls& out) const {
    const RangeAxes& axes = at(level).axes;
    find_box_ranges(axes, given_points(lights.all), lights.test.own_padding(), out);
    if (!lights.all.spots.empty()) find_box_ranges(axes, given_spots(lights.all, lights.spots), 0.0f, out);
  }
  void find_rows(int level, const BallBatch& batch, BatchRows& out) {
    find_box_rows(at(level).cells, batch, lane_columns_, out);
  }

  std::size_t capacity_bytes() const {
    std::size_t bytes = lane_columns_.capacity_bytes();
    for (const BoxLevel& level : levels_) bytes += level.axes.capacity_bytes() + level.cells.capacity_bytes();
    return bytes;
  }

 private:
  struct BoxLevel {
    RangeAxes axes;
    CellExtents cells;
    int slices;

    explicit BoxLevel(const BoxGrid& boxes)
        : axes(boxes), cells(extents_of(boxes)), slices(static_cast<int>(boxes.z.size())) {}
  };

  const BoxLevel& at(int level) const { return levels_[static_cast<std::size_t>(level)]; }

  std::vector<BoxLevel> levels_;
  LaneColumns lane_columns_;
};

}  // namespace clusterbench::assign
