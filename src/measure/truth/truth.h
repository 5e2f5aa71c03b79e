#pragma once
// The true lists of a frame: light volume and cell share a point, touching included. The volume is taken from the
// scene's double-precision values and the double-precision camera matrix, all exactly; the cells' numbers are exact as
// given.

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
  std::uint64_t filter_decided = 0;  // pairs near the boundary and others that the double-precision filter decided
  std::uint64_t exact_decided = 0;   // left undecided by the filter, decided or proven in exact arithmetic
  std::uint64_t undecided = 0;       // even then
};

class TruthCells;  // measure/truth/truth_cells.h

// Of cells of any kind. Independent of the number of threads. Throws Error beyond the limit on memory.
Truth find_truth(const view::Frame& frame, const TruthCells& cells, int threads);
Truth find_truth(const view::Frame& frame, const grid::Grid& grid, int threads);
// For cells that depths leave of a frustum grid's: a light is in a cell if it meets one of its parts.
Truth find_truth(const view::Frame& frame, const grid::Grid& grid, const grid::OccupiedCells& cells, int threads);

// Distance from the light's centre (apex) to the nearest point of cell ∩ volume's cone, divided by the range; of a box
// the scale about its middle at which it begins to touch the cell. How deep a missed pair lies is 1 - this. `light` is
// an index into frame.lights.
// Asked only whether it is below a number: 1 where it is not.
double relative_distance(const view::Frame& frame, const grid::Grid& grid, std::uint32_t cell, std::uint32_t light,
                         double below = 1.0);
double relative_distance(const geom::LightVolume& light, const geom::Cell& cell, double below = 1.0);

}  // namespace clusterbench::measure
