#pragma once
// Balls and spots against a grid of axis-aligned boxes, row by row: the common part of the assigners of world and
// cascades. A ball touches a box iff the squared distance from its centre to the box, summed over the axes, is at most
// r². Along a row only x changes, so the boxes that a ball touches there are one interval.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "assign/bounds/cell_extents.h"
#include "assign/contract/light_test.h"
#include "assign/contract/lists.h"
#include "core/arrays.h"
#include "geom/shapes/ball_and_cone.h"
#include "grid/index_range.h"

namespace clusterbench::assign {

// The boxes' extents along one axis in index order: adjacent, ascending or descending.
using BoxAxis = std::vector<Interval>;

using grid::IndexRange;

// Boxes, numbered along x first, then y, then z, from first_cell on.
struct BoxGrid {
  BoxAxis x, y, z;
  std::uint32_t first_cell = 0;
  IndexRange hole_x, hole_y, hole_z;  // boxes that have no lists; empty: none

  std::size_t capacity_bytes() const { return bytes_of(x, y, z); }
};

// Distance from a coordinate on the axis to an extent; 0 inside.
inline float gap_to(const Interval& extent, float coordinate) {
  return std::max(0.0f, std::max(extent.lo - coordinate, coordinate - extent.hi));
}

inline float squared_gap(const Interval& extent, float coordinate) {
  const float gap = gap_to(extent, coordinate);
  return gap * gap;
}

// The indices whose extent lies within r of the coordinate.
IndexRange indices_within(const BoxAxis& axis, float coordinate, float r);

// Calls row(y, z, first_x, last_x) for each row of boxes that the ball touches, and adds the number of tested boxes to
// `tests`. Finds the interval by testing inward from both ends of the ball's x range.
template <class Row>
void for_each_row_touched(const BoxGrid& boxes, const geom::Ball& ball, std::uint64_t& tests, Row&& row) {
  const float squared_radius = ball.radius * ball.radius;
  const IndexRange xs = indices_within(boxes.x, ball.center.x, ball.radius);
  const IndexRange ys = indices_within(boxes.y, ball.center.y, ball.radius);
  const IndexRange zs = indices_within(boxes.z, ball.center.z, ball.radius);
  for (int z = zs.first; z <= zs.last; ++z) {
    const float gap_z = squared_gap(boxes.z[static_cast<std::size_t>(z)], ball.center.z);
    for (int y = ys.first; y <= ys.last; ++y) {
      const float gap_y = squared_gap(boxes.y[static_cast<std::size_t>(y)], ball.center.y);
      const auto touched = [&](int x) {
        ++tests;  // geom::ball_touches_box, summed in its order
        return squared_gap(boxes.x[static_cast<std::size_t>(x)], ball.center.x) + gap_y + gap_z <= squared_radius;
      };
      int first = xs.first, last = xs.last;
      while (first <= last && !touched(first)) ++first;
      while (last > first && !touched(last)) --last;
      if (first <= last) row(y, z, first, last);
    }
  }
}

// Adds the cells of these boxes that a light touches.
//
// Roundoffs: each axis's gap is one difference, off by 2^-24 of itself; squaring, two sums and the squared radius leave
// the compared squares off by at most 5 * 2^-24 of themselves, so the distance by 2.5; with the gaps' 1: 3.5.
inline constexpr float k_box_roundoffs = 4.0f;
void add_boxes(const BoxGrid& boxes, const LightTest& test, const TestedLight& light, PairBuffer& pairs,
               std::uint64_t& tests);

}  // namespace clusterbench::assign
