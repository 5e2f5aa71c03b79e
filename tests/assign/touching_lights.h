#pragma once
// Lights that reach into a known cell by a hair: made from a point of the cell's surface and a direction out of the
// cell.

#include <vector>

#include "grid/grid.h"
#include "view/frame.h"

namespace clusterbench::assign::testing {

struct TouchingLight {
  scene::WorldLight light;
  std::uint32_t cell;  // must list it
};

// `count` points and `count` spots. How far they reach in goes from what double precision can tell to 1e-6 of their
// size; spots touch by their cap, their side or their apex.
std::vector<TouchingLight> touching_points(const grid::Grid& grid, const view::Space& space, int count,
                                           std::uint64_t seed);
std::vector<TouchingLight> touching_spots(const grid::Grid& grid, const view::Space& space, int count,
                                          std::uint64_t seed);

}  // namespace clusterbench::assign::testing
