#pragma once
// The cell boxes of many balls at once: those of cell_box() (assign/bounds/cell_bounds.h), because each lane takes the
// same operations on the same numbers in the same order, in double precision where cell_box() does.

#include <cstdint>
#include <vector>

#include "assign/bounds/cell_bounds.h"
#include "assign/rows/slice_rows.h"
#include "assign/simd/boundary_axis.h"
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

// Balls that have a cell box, ascending by light. All arrays have room for whole vectors beyond `count`.
struct BoxedBalls {
  std::uint32_t count = 0;
  AlignedVector<float> x, y, depth, radius;
  AlignedVector<std::uint32_t> light;
  AlignedVector<std::int32_t> first_column, last_column, first_row, last_row, first_slice, last_slice;
  AlignedVector<float> low_x, high_x, low_y, high_y, box_radius, ball_radius;  // of the seen balls, on the way

  CellBox box(std::uint32_t place) const {
    return {{first_column[place], first_row[place], first_slice[place]},
            {last_column[place], last_row[place], last_slice[place]}};
  }
  // An empty box reaches no slice.
  void set_box(std::uint32_t place, const CellBox& box) {
    first_column[place] = box.first.x;
    last_column[place] = box.last.x;
    first_row[place] = box.first.y;
    last_row[place] = box.last.y;
    first_slice[place] = box.first.z;
    last_slice[place] = box.empty() ? box.first.z - 1 : box.last.z;
  }
  void reserve(std::uint32_t most);
  std::size_t capacity_bytes() const;
};

// Units of 2^-24 of a light's reach by which its ball is made larger.
struct BallPadding {
  float box;   // for its cell box
  float ball;  // for the ball that is kept
};

// Appends the balls from place `begin` of `seen` on that have a cell box. They are balls of `given`, of which the first
// belongs to light `first_light`.
void find_screen_bounds(const BoxPlanes& planes, const VisibleBalls& visible, std::uint32_t begin,
                        const GivenBalls& given, std::uint32_t first_light, const BallPadding& padding,
                        BoxedBalls& boxed);

}  // namespace clusterbench::assign
