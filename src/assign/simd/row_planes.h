#pragma once
// The planes of a frustum grid, as rows of cells want them.

#include <vector>

#include "grid/grid.h"

namespace clusterbench::assign {

// The planes of a grid as vectors want them. Made once per grid. A slope is x / depth or y / depth; where the
// projection is orthographic, x or y itself.
struct RowPlanes {
  bool orthographic = false;
  std::vector<float> slope, tilt, inverse_tilt;  // of the tile planes from the top; sqrt(1 + slope²); padded
  std::vector<float> depth, inverse_depth;       // of the slice planes
  std::vector<float> searched;                   // the slices' near depths, then +inf up to 2^n of them
  std::vector<float> side;                       // slopes of the columns, padded by whole vectors
  int rows = 0, columns = 0, slices = 0;
  float left = 0.0f, right = 0.0f, columns_per_slope = 0.0f, column_margin = 0.0f;
  float rows_per_slope = 0.0f, row_margin = 0.0f;

  explicit RowPlanes(const grid::ScreenGrid& grid);
  RowPlanes() = default;
};

}  // namespace clusterbench::assign
