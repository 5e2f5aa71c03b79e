#pragma once
// The boxes of the grids whose cells are boxes. The broad phase of the truth (grid/broad_phase.h) finds them by itself:
// truth shares no step with what it judges.

#include <vector>

#include "assign/box_grid/box_rows.h"
#include "grid/grid.h"

namespace clusterbench::assign {

// World: one level; cascades: one per level, from the finest, one after the other in the order of cells.
std::vector<BoxGrid> box_levels(const grid::Grid& grid);

}  // namespace clusterbench::assign
