#pragma once
// Do lights touch cells of a frustum grid? Many pairs at once, by the point of the cells that is nearest to a light's
// centre: in doubles with a bound of their error, as geom::BallDecider does before it turns to exact numbers (its
// answers are the same; which pairs are left uncertain is not).

#include <cstdint>
#include <vector>

#include "assign/cone/spot_cell_filter.h"
#include "assign/grid_cull/row_planes.h"
#include "core/arrays.h"
#include "grid/index_range.h"
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

// Spots that may just touch runs of cells. If the nearest point lies at the range, or beyond, it tells whether there is
// a common point; on lattices, where nothing or little is rounded, it does even where it is the only one, and then says
// in which columns.
struct SpotTouches {
  SpotCells runs;
  // Of the nearest point, from the eye.
  std::vector<double> x, x_error, depth, depth_error;
  std::vector<std::uint8_t> is_alone;  // the only one that is shared
  std::vector<std::int8_t> side;       // -1: on the run's left side, 1: on its right one

  // Spots of less reach than planes.least_reach, or of more than k_most_row_reach, are left uncertain.
  void look(const view::LightArrays& lights, const RowPlanes& planes);
  // Columns of a run that are touched, and no others of it are: where a point is all that is shared. Empty where that
  // is not known.
  grid::IndexRange only_columns(std::uint32_t index, const RowPlanes& planes) const;
  std::size_t capacity_bytes() const {
    return runs.capacity_bytes() + bytes_of(x, x_error, depth, depth_error, is_alone, side);
  }
};

}  // namespace clusterbench::assign
