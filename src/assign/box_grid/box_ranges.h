#pragma once
// The boxes of a grid of axis-aligned boxes that are within reach of many balls on each axis. The same as
// indices_within() (assign/box_grid/box_rows.h), a vector of balls at a time, because each lane compares the same
// differences.

#include "assign/bounds/boundary_axis.h"
#include "assign/bounds/bounds_rows.h"
#include "assign/box_grid/box_rows.h"
#include "assign/grid_cull/frustum_cull.h"

namespace clusterbench::assign {

// The boundaries between the boxes along one axis, negated if the boxes descend.
struct RangeAxis : BoundaryAxis {
  bool descends = false;

  explicit RangeAxis(const BoxAxis& axis);
};

// A grid of boxes, or a level of one. Made once per grid.
struct RangeAxes {
  RangeAxis x, y, z;
  grid::IndexRange hole_x, hole_y, hole_z;

  explicit RangeAxes(const BoxGrid& boxes);
  std::size_t capacity_bytes() const;
};

// The boxes' extents, for find_box_rows().
CellExtents extents_of(const BoxGrid& boxes);

// Appends the balls, enlarged by these roundoffs, that reach a box outside of the hole. bounded's columns are along x,
// its rows along y, its slices along z, and depth is -z.
void find_box_ranges(const RangeAxes& axes, const GivenBalls& balls, float roundoffs, BoundedBalls& bounded);

}  // namespace clusterbench::assign
