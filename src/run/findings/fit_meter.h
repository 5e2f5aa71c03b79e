#pragma once
// Slices that follow a frame's needs (grid/needed_span.h), beside the same grid without that: savings, movement from
// frame to frame, and the number of lists that another frame has to write again.

#include <cstddef>
#include <vector>

#include "config/config.h"
#include "grid/grid.h"
#include "run/findings/case_side.h"

namespace clusterbench::run {

// Boundaries of slices along a path. A step leads from one frame to the next.
struct GridMoves {
  // Start of the slices in frames that need some (exponential-first: end of the first slice); end of the slices in all
  // frames.
  Extremes near_m, far_m;
  int steps = 0, changed = 0;  // changed: steps to a grid with other boundaries
  double cells_changed = 0.0;  // sum over steps: share of cells that differ from the previous frame
  Extremes moved;              // movement of each boundary in each step, in thicknesses of the slice in front of it
};

class GridMoveMeter {
 public:
  // `near_boundary`: the first boundary that follows.
  explicit GridMoveMeter(std::size_t near_boundary) : near_boundary_(near_boundary) {}
  // Once per frame, in the path's order; `needed`: the span for which the grid was made.
  void add(const grid::ScreenGrid& grid, const grid::Span& needed);
  const GridMoves& result() const { return moves_; }

 private:
  std::size_t near_boundary_;
  std::vector<float> before_;
  GridMoves moves_;
};

// A case beside the same case in the grid that does not follow.
struct FitResult {
  grid::Fit fit;
  grid::Span range;  // range within which slices follow, in the last frame
  GridMoves moves;
  CaseSide fitted, unfitted;
};

// The configuration with this grid changed so that it follows nothing.
config::Config without_fit(const config::Config& config, std::size_t grid);

}  // namespace clusterbench::run
