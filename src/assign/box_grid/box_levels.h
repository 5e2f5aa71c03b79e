#pragma once
// The boxes of the grids whose cells are boxes. The broad phase of the truth (grid/broad_phase.h) finds them by itself:
// truth shares no step with the methods that it checks.

#include <vector>

#include "assign/box_grid/box_rows.h"
#include "grid/grid.h"

namespace clusterbench::assign {

// World: one level. Cascades: one level per cascade, from the finest, in the order of cells.
std::vector<BoxGrid> box_levels(const grid::Grid& grid);

}  // namespace clusterbench::assign
