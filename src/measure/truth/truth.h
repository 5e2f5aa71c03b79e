#pragma once
// The true lists of a frame: light volume and cell share a point, touching included. The volume uses the scene's
// double-precision values and the double-precision camera matrix, all exactly; the cells use their own numbers exactly.

#include <cstdint>

#include "assign/contract/lists.h"
#include "geom/shapes/cell.h"
#include "geom/shapes/light_volume.h"
#include "grid/grid.h"
#include "grid/occupied_cells.h"
#include "view/frame.h"

namespace clusterbench::measure {

struct Truth {
  assign::Lists lists;               // an undecided pair counts as true
  std::uint64_t filter_decided = 0;  // pairs near the boundary and others, decided by the double-precision filter
  std::uint64_t exact_decided = 0;   // left undecided by the filter, decided or proven in exact arithmetic
  std::uint64_t undecided = 0;       // undecided by both
};

class TruthCells;  // measure/truth/truth_cells.h

// For cells of any kind. The result does not depend on the number of threads. Throws Error beyond the memory limit.
Truth find_truth(const view::Frame& frame, const TruthCells& cells, int threads);
Truth find_truth(const view::Frame& frame, const grid::Grid& grid, int threads);
// For the occupied cells of a frustum grid: a light is in a cell if it meets one of its parts.
Truth find_truth(const view::Frame& frame, const grid::Grid& grid, const grid::OccupiedCells& cells, int threads);

// Distance from the light's centre (apex) to the nearest point of the intersection of cell and cone, divided by the
// range; for a box light the scale around its middle at which it begins to touch the cell. The depth of a missed pair
// is 1 - this. `light` is an index into frame.lights. Exact only below `below`; otherwise 1.
double relative_distance(const view::Frame& frame, const grid::Grid& grid, std::uint32_t cell, std::uint32_t light,
                         double below = 1.0);
double relative_distance(const geom::LightVolume& light, const geom::Cell& cell, double below = 1.0);

}  // namespace clusterbench::measure
