#pragma once
// Whether a frame's lights can reach a point in view outside of all grid cells. If none can, samples outside of the
// cells lose no light; this is proven without samples.

#include <cstdint>
#include <vector>

#include "grid/grid.h"
#include "view/frame.h"

namespace clusterbench::measure {

// Whether the light, if it is in view (grid/lights_in_view.h), may reach a point in view outside of all cells.
// Conservative: a spot is tested by the smaller of the balls around its cone and its range, a box light by its bounding
// box. It can return true for a light that does not reach such a point, but never false for one that does.
bool may_reach_beyond(const view::Frame& frame, const grid::Grid& grid, const scene::WorldLight& light);

// Counts over the frames of a path, each with its own grid.
struct LightsBeyondGrid {
  std::uint64_t most = 0;  // in the frame with most
  int frames = 0;          // with such a light
};
// `in_view`: grid::lights_in_view() of the frame.
void add_frame(LightsBeyondGrid& counts, const view::Frame& frame, const grid::Grid& grid,
               const std::vector<bool>& in_view);

}  // namespace clusterbench::measure
