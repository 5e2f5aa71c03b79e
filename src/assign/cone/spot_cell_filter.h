#pragma once
// Do spots touch cells? Many pairs at once: a filter in single precision that says yes or no only with
// evidence (a point that is in cell and volume, or a plane between them) that is larger than its own error, and leaves
// the rest to exact arithmetic.

#include <cstdint>
#include <vector>

#include "assign/rows/slice_rows.h"
#include "core/arrays.h"
#include "view/frame.h"

namespace clusterbench::assign {

enum class Touch : std::uint8_t { no, yes, uncertain };

// A spot (light index - points) and neighbouring cells of a row as one: columns column .. end_column - 1.
struct SpotCell {
  std::uint32_t spot, slice, row, column, end_column;
};

// Pairs of a spot and one or more cells, and the answers. Whole vectors can be read and written beyond `count`.
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
  // What a whole vector reads beyond the end must be indices that exist.
  void pad();
  std::size_t capacity_bytes() const { return bytes_of(spot, slice, row, column, end_column, touch); }
};

// A cell's corner well inside of the volume, or a face of the cell between, or a plane along the cone's side. Spots
// whose reach and range together are not from planes.least_reach to k_most_row_reach are left uncertain.
void look_at_cells(const view::LightArrays& lights, const RowPlanes& planes, SpotCells& cells);

}  // namespace clusterbench::assign
