#version 460
#extension GL_GOOGLE_include_directive : require
#define CELLS_ACCESS
#include "common.glsl"
#include "around.glsl"
#include "boundaries.glsl"

// The bounds of a grid's cells from its boundaries, one invocation per cell; with k_with_balls the balls around them, too.
const uint k_with_balls = 1;  // MODE

void main() {
  uint index = invocation_index();
  if (index >= frame.cells) return;
  uint column = index % frame.columns, row = index / frame.columns % frame.rows,
       slice = index / frame.columns / frame.rows;
  Sides sides = sides_of(uvec3(column, row, slice));
  Around cell = around(sides.x, sides.y, sides.depth);
  if (row == 0) bounds[slice * frame.column_pitch + column] = vec2(cell.lo.x, cell.hi.x);
  if (column == 0) bounds[frame.first_row + slice * frame.row_pitch + row] = vec2(cell.lo.y, cell.hi.y);
  if (row == 0 && column == 0) bounds[frame.first_slice + slice] = vec2(cell.lo.z, cell.hi.z);
  if (MODE == k_with_balls) cell_balls[index] = cell.ball;
}
