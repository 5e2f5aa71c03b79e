#pragma once
// Whether a frame's lights can reach a point in view that lies in no cell of the grid. Where none can, samples beyond
// the cells lack nothing: by reasoning, however few they are.

#include <cstdint>

#include "grid/grid.h"
#include "view/frame.h"

namespace clusterbench::measure {

// Whether the light, if it is in view (grid/lights_in_view.h), may reach a point in view beyond all cells. "May": of a
// spot the smaller of the balls around its cone and its range, in boxes the box around the light decides, so some count
// that do not; none that does is left out.
bool may_reach_beyond(const view::Frame& frame, const grid::Grid& grid, const scene::WorldLight& light);

// Over the frames of a path, in each frame's grid.
struct LightsBeyondGrid {
  std::uint64_t most = 0;  // in the frame with most
  int frames = 0;          // with such a light
};
void add_frame(LightsBeyondGrid& counts, const view::Frame& frame, const grid::Grid& grid);

}  // namespace clusterbench::measure
