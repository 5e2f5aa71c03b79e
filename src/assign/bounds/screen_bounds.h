#pragma once
// The cell boxes of many balls at once. They equal those of cell_box() (assign/bounds/cell_bounds.h), because each lane
// does the same operations on the same numbers in the same order, in double precision where cell_box() does.

#include <cstdint>
#include <vector>

#include "assign/bounds/boundary_axis.h"
#include "assign/pipeline/bounded_balls.h"
#include "assign/rows/slice_rows.h"
#include "grid/grid.h"

namespace clusterbench::assign {

// The boundaries of a grid. Made once per grid.
struct BoxPlanes {
  BoundaryAxis columns;       // slopes x / depth, orthographic: x
  BoundaryAxis rows;          // slopes -y / depth or -y: rows begin at the top
  std::vector<float> depths;  // of the slices
  bool orthographic = false;

  explicit BoxPlanes(const grid::ScreenGrid& grid);
  BoxPlanes() = default;
  int slices() const { return static_cast<int>(depths.size()) - 1; }
};

// Units of 2^-24 of a light's reach by which its ball is enlarged.
struct BallPadding {
  float box;   // for its cell box
  float ball;  // for the stored ball
};

// Appends the balls of `visible` from index `begin` on that have a box of cells. They are balls of `given`.
void find_screen_bounds(const BoxPlanes& planes, const VisibleBalls& visible, std::uint32_t begin,
                        const GivenBalls& given, const BallPadding& padding, BoundedBalls& bounded);

}  // namespace clusterbench::assign
