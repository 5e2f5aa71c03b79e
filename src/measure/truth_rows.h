#pragma once
// Which cells a ball can touch, row by row, in double precision: for each row an outer range of columns beyond which no
// cell is touched, and an inner range of columns that are touched for certain.
//
// Outer and inner come from the same formulas with the radius made larger or smaller by a slack. All that double
// precision loses in them (rounded squares under a root, rounded centres, rounded quotients) moves a result no further
// than moving the centre or the surface by a few roundoffs of the coordinates would; the slack is hundreds of these.

#include <vector>

#include "geom/shapes/vec.h"
#include "grid/grid.h"
#include "grid/index_range.h"

namespace clusterbench::measure {

// A light's ball (of a spot: its range) in the grid's space.
struct BallInSpace {
  Vec3d center{0.0};
  double radius = 0.0;  // finite
  double slack = 0.0;
};

using ColumnRange = grid::IndexRange;

struct Row {
  std::uint32_t first_cell = 0;  // of the row's column 0
  ColumnRange outer, inner;
};

// Perspective frustum grids: rows of cells by the extremes of slope over row ∩ ball.
void append_rows(const grid::ScreenGrid& grid, const BallInSpace& ball, std::vector<Row>& rows);

// Rows of tiles of a distance grid, all shells taken together: inner stays empty.
void append_tile_rows(const grid::ScreenGrid& grid, const BallInSpace& ball, std::vector<Row>& rows);

// A block of boxes, numbered x fastest from first_cell. Extents per index, ascending or descending.
struct Extent {
  double lo, hi;
};
struct BoxBlock {
  std::vector<Extent> x, y, z;  // x ascends
  std::uint32_t first_cell = 0;
  ColumnRange hole_x{}, hole_y{}, hole_z{};  // indices of the block that is cut out of it
};

// The grid's boxes: an orthographic frustum grid, a world grid, or one block per level of cascades.
std::vector<BoxBlock> box_blocks(const grid::Grid& grid);
// Rows beside a hole come in two runs.
void append_rows(const BoxBlock& block, const BallInSpace& ball, std::vector<Row>& rows);

}  // namespace clusterbench::measure
