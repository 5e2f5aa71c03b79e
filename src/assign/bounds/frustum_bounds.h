#pragma once
// The boxes of cells of a frame's lights on a frustum grid, a vector at a time. Lights beside the view are left out
// first, because they are the majority in a large level.

#include "assign/bounds/screen_bounds.h"

namespace clusterbench::assign {

// Keeps its memory between frames.
class FrustumBounds {
 public:
  void build(const grid::ScreenGrid& grid) {
    planes_ = RowPlanes(grid);
    boundaries_ = BoxPlanes(grid);
  }
  int slices() const { return boundaries_.slices(); }

  // To be called before the first find() of a frame with this many lights.
  void start_frame(std::uint32_t lights) {
    visible_.count = 0;
    visible_.reserve(lights);
  }
  // Appends the balls that have a box of cells. `out` has room for all lights.
  void find(const GivenBalls& balls, const BallPadding& padding, BoundedBalls& out) {
    const std::uint32_t begin = visible_.count;
    cull_balls(planes_, balls, visible_, padding.box + k_slice_rows_roundoffs);
    find_screen_bounds(boundaries_, visible_, begin, balls, padding, out);
  }

  std::size_t capacity_bytes() const { return visible_.capacity_bytes(); }

 private:
  RowPlanes planes_;
  BoxPlanes boundaries_;
  VisibleBalls visible_;
};

}  // namespace clusterbench::assign
