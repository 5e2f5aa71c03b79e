#pragma once
// Stage 2 of the spot cascade (spot_rows.h), the filter: does a spot touch a cell? It tests many pairs at once in
// single precision. It answers yes only with a common point, and no only with a separating plane; the margin of both
// must be larger than the rounding error. All other pairs stay uncertain and go to exact arithmetic.

#include <cstdint>
#include <vector>

#include "assign/rows/slice_rows.h"
#include "core/arrays.h"
#include "view/frame.h"

namespace clusterbench::assign {

enum class Touch : std::uint8_t { no, yes, uncertain };

// A spot (light index - number of points) and neighbouring cells of a row, tested as one cell: columns column ..
// end_column - 1.
struct SpotCell {
  std::uint32_t spot, slice, row, column, end_column;
};

// Pairs of a spot and one or more cells, and the results. Whole vectors can be read and written beyond `count`.
struct SpotCells {
  std::uint32_t count = 0;
  std::vector<std::uint32_t> spot, slice, row, column, end_column;
  std::vector<Touch> touch;

  void add(const SpotCell& pair) {
    if (count + k_most_lanes >= spot.size()) grow();
    spot[count] = pair.spot;
    slice[count] = pair.slice;
    row[count] = pair.row;
    column[count] = pair.column;
    end_column[count++] = pair.end_column;
  }
  void grow();
  // A whole vector reads past the end: fills that part with valid indices.
  void pad();
  std::size_t capacity_bytes() const { return bytes_of(spot, slice, row, column, end_column, touch); }
};

// Tests all pairs with these stages, each only if some pair is still uncertain: a corner of the cell inside the spot,
// or a separating plane (a face of the cell, or a plane along the cone's side); more planes along the cone's side;
// alternating projections. Spots with reach + range outside planes.least_reach .. k_most_row_reach stay uncertain.
void filter_spot_cells(const view::LightArrays& lights, const RowPlanes& planes, SpotCells& cells);

}  // namespace clusterbench::assign
