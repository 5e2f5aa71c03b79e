#version 460
#extension GL_GOOGLE_include_directive : require
#define CELLS_ACCESS
#include "common.glsl"
#include "around.glsl"

// The bounds of a grid's cells from its boundaries, one invocation per cell; with k_with_balls the balls around them, too.
const uint k_with_balls = 1;  // MODE

// Of columns ascending, of rows from the top, of slices.
layout(std430, set = 0, binding = 11) readonly buffer Boundaries { float boundaries[]; };

void main() {
  uint index = invocation_index();
  if (index >= frame.cells) return;
  uint column = index % frame.columns, row = index / frame.columns % frame.rows,
       slice = index / frame.columns / frame.rows;
  uint rows = frame.columns + 1, slices = rows + frame.rows + 1;
  Around cell = around(vec2(boundaries[column], boundaries[column + 1]),
                       vec2(boundaries[rows + row + 1], boundaries[rows + row]),
                       vec2(boundaries[slices + slice], boundaries[slices + slice + 1]));
  if (row == 0) bounds[slice * frame.column_pitch + column] = vec2(cell.lo.x, cell.hi.x);
  if (column == 0) bounds[frame.first_row + slice * frame.row_pitch + row] = vec2(cell.lo.y, cell.hi.y);
  if (row == 0 && column == 0) bounds[frame.first_slice + slice] = vec2(cell.lo.z, cell.hi.z);
  if (MODE == k_with_balls) cell_balls[index] = cell.ball;
}
