#pragma once
// Stage 2 of the cascade (cone/spot_rows.h), a filter by nearest points: do lights touch cells of a frustum grid? For
// many pairs at once it finds the point of the cells that is nearest to a light's centre, in doubles with an error
// bound, as geom::BallDecider does before it uses exact numbers. Its answers are the same; it may leave other pairs
// uncertain.

#include <cstdint>
#include <vector>

#include "assign/cone/spot_cell_filter.h"
#include "assign/grid_cull/row_planes.h"
#include "core/arrays.h"
#include "grid/index_range.h"
#include "view/frame.h"

namespace clusterbench::assign {

// Pairs of a ball and a cell, and the results. Whole vectors can be read and written beyond `count`.
struct BallCells {
  std::uint32_t count = 0;
  std::vector<std::int32_t> light, slice, row, column;  // for lights without end the result has no meaning
  std::vector<Touch> touch;

  // Must be called before the first add().
  void reserve(std::size_t most) { grow_to(most + k_most_lanes, light, slice, row, column, touch); }
  void add(std::uint32_t of_light, int in_slice, int in_row, int in_column) {
    light[count] = static_cast<std::int32_t>(of_light);
    slice[count] = in_slice;
    row[count] = in_row;
    column[count++] = in_column;
  }
  std::size_t capacity_bytes() const { return bytes_of(light, slice, row, column, touch); }
};

// `planes`: of the grid in whose space the lights are.
void filter_ball_cells(const view::LightArrays& lights, const RowPlanes& planes, BallCells& cells);

// Spots that may touch runs of cells in a single point. A run is decided if its nearest point lies at the spot's range
// or beyond it. On lattices, where little or nothing is rounded, this also works if that point is the only common one;
// then the touched columns are known, too.
struct SpotContacts {
  SpotCells runs;
  // The nearest point, relative to the eye.
  std::vector<double> x, x_error, depth, depth_error;
  std::vector<std::uint8_t> is_only_point;  // flag: the nearest point is the only common one
  std::vector<std::int8_t> side;            // -1: it is on the run's left side, 1: on its right side

  // Spots of reach below planes.least_reach or above k_most_row_reach stay uncertain.
  void test(const view::LightArrays& lights, const RowPlanes& planes);
  // The columns of a run that are touched, if they are known, that is, if there is only one common point. Otherwise
  // empty.
  grid::IndexRange only_touched_columns(std::uint32_t index, const RowPlanes& planes) const;
  std::size_t capacity_bytes() const {
    return runs.capacity_bytes() + bytes_of(x, x_error, depth, depth_error, is_only_point, side);
  }
};

}  // namespace clusterbench::assign
