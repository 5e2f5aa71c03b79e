#pragma once
// Do point lights touch single cells of a frustum grid? Many pairs at once, in doubles with a bound of their error, as
// geom::BallDecider does before it turns to exact numbers (its answers are the same; which pairs are left uncertain is
// not).

#include <cstdint>
#include <vector>

#include "assign/cone/spot_cell_filter.h"
#include "assign/cull/row_planes.h"
#include "core/arrays.h"
#include "view/frame.h"

namespace clusterbench::assign {

// Pairs of a ball and a cell, and the answers. Whole vectors can be read and written beyond `count`.
struct BallCells {
  std::uint32_t count = 0;
  std::vector<std::int32_t> light, slice, row, column;  // of endless lights nothing is said
  std::vector<Touch> touch;

  // Before the first add().
  void reserve(std::size_t most) { grow_to(most + k_most_lanes, light, slice, row, column, touch); }
  void add(std::uint32_t of_light, int in_slice, int in_row, int in_column) {
    light[count] = static_cast<std::int32_t>(of_light);
    slice[count] = in_slice;
    row[count] = in_row;
    column[count++] = in_column;
  }
  std::size_t capacity_bytes() const { return bytes_of(light, slice, row, column, touch); }
};

// `planes`: those of the grid in whose space the lights are.
void look_at_balls(const view::LightArrays& lights, const RowPlanes& planes, BallCells& cells);

}  // namespace clusterbench::assign
