#pragma once
// The box of cells that a ball's extents on the screen and in depth cover: Persson's "cube" of clusters around a light.

#include "assign/pipeline/bounded_balls.h"
#include "geom/shapes/ball_and_cone.h"
#include "grid/grid.h"

namespace clusterbench::assign {

// For frustum grids. Boundaries are compared directly, so no logarithm can disagree with them. Conservative for a ball
// padded by k_cell_box_roundoffs: slopes are bounded outward in double precision, depth - r and depth + r are rounded
// once.
inline constexpr float k_cell_box_roundoffs = 1.0f;
CellBox cell_box(const grid::Grid& grid, const geom::Ball& ball);

}  // namespace clusterbench::assign
