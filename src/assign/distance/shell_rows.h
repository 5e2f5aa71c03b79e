#pragma once
// The columns that balls touch in the rows of a shell of distances: assigners/distance.cpp with one ball per lane, the
// same operations in the same order, in double precision where that file uses it.

#include <vector>

#include "assign/bounds/bounds_rows.h"
#include "assign/bounds/screen_bounds.h"
#include "assign/bounds/tile_planes.h"
#include "grid/grid.h"

namespace clusterbench::assign {

// The planes and shells of a distance grid. Made once per grid.
struct ShellPlanes {
  BoxPlanes boundaries;                // `depths` are the shells' distances
  std::vector<float> slope;            // y / depth of the tile planes from the top
  TilePlane left, right, top, bottom;  // of the view

  explicit ShellPlanes(const grid::ScreenGrid& grid);
  ShellPlanes() = default;
  int rows() const { return static_cast<int>(slope.size()) - 1; }
  std::size_t capacity_bytes() const;
};

// Appends the balls, enlarged by these roundoffs, that may reach a shell within the view, with all shells that they may
// reach and all rows. The others touch no cell, not even with rounding errors.
void find_shells(const ShellPlanes& planes, const GivenBalls& balls, float roundoffs, BoundedBalls& bounded);

// The batch's slice is the shell.
void find_shell_rows(const ShellPlanes& planes, const BallBatch& batch, BatchRows& out);

}  // namespace clusterbench::assign
