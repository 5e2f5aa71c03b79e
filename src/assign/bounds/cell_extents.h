#pragma once
// The boxes around the cells of a grid, axis by axis: within a slice a cell's box has its column's extent in x, its
// row's in y and the slice's in z.

#include <vector>

#include "core/arrays.h"
#include "grid/grid.h"

namespace clusterbench::assign {

struct Interval {
  float lo, hi;
};

struct CellExtents {
  struct Axis {
    std::vector<Interval> extents;
    int pitch = 0;  // from one slice to the next; 0: the same for all slices
  };
  Axis x, y, z;
  int columns = 0, rows = 0;

  std::size_t capacity_bytes() const { return bytes_of(x.extents, y.extents, z.extents); }
};

// The extents of a frustum grid's cells.
CellExtents cell_extents(const grid::Grid& grid);

}  // namespace clusterbench::assign
