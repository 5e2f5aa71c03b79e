#pragma once
// The broad phase of frustum and distance grids, and that of tiles through all depths.

#include <vector>

#include "grid/broad_phase.h"
#include "grid/screen_grid.h"

namespace clusterbench::grid {

// Tiles of a perspective picture that the ball may touch at some depth; inner stays empty.
void append_tile_rows(const Tiles& tiles, const BallInSpace& ball, std::vector<CellRow>& rows);

}  // namespace clusterbench::grid
