#pragma once
// What slices that follow a frame's needs (grid/needed_span.h) save and risk, beside the same grid without: how far
// they move from frame to frame, and how many lists another frame has to write anew.

#include <cstddef>
#include <vector>

#include "config/config.h"
#include "grid/grid.h"
#include "run/findings/case_side.h"

namespace clusterbench::run {

// Boundaries of slices along a path. A step leads from one frame to the next.
struct GridMoves {
  // Of frames that need something: where slices begin (exponential-first ones: where the first one ends). Of all: where
  // they end.
  Extremes near_m, far_m;
  int steps = 0, changed = 0;  // changed: steps to a grid with other boundaries
  double cells_changed = 0.0;  // sum over steps: share of the cells that are other ones than before
  Extremes moved;              // of each boundary in each step: how far, in thicknesses of the slice before it
};

class GridMoveMeter {
 public:
  // `near_boundary`: the first one that follows.
  explicit GridMoveMeter(std::size_t near_boundary) : near_boundary_(near_boundary) {}
  // Once per frame, in the path's order; `needed` is what the grid was made for.
  void add(const grid::ScreenGrid& grid, const grid::Span& needed);
  const GridMoves& result() const { return moves_; }

 private:
  std::size_t near_boundary_;
  std::vector<float> before_;
  GridMoves moves_;
};

// A case beside the same in the grid that does not follow.
struct FitResult {
  grid::Fit fit;
  grid::Span asked;  // within which slices follow; in the last frame
  GridMoves moves;
  CaseSide fitted, unfitted;
};

// The configuration with this grid not following anything.
config::Config without_fit(const config::Config& config, std::size_t grid);

}  // namespace clusterbench::run
