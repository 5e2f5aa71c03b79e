#pragma once
// What slices that follow a frame's needs (grid/needed_span.h) save and risk, beside the same grid without: how far
// they move from frame to frame, and how many lists another frame has to write anew.

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assign/contract/lists.h"
#include "config/config.h"
#include "grid/grid.h"
#include "measure/buffers.h"

namespace clusterbench::run {

// Smallest, mean and largest of one number per frame.
struct Extremes {
  double least = std::numeric_limits<double>::infinity(), sum = 0.0,
         greatest = -std::numeric_limits<double>::infinity();
  int count = 0;

  void add(double value);
  double mean() const { return sum / count; }
};

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

// Lists that hold other lights than the same cell's in the frame before.
struct ListChanges {
  std::uint64_t lists = 0, changed = 0;  // over all steps

  double share() const { return static_cast<double>(changed) / static_cast<double>(lists); }
};

class ListChangeMeter {
 public:
  void add(const assign::Lists& lists);
  const ListChanges& result() const { return changes_; }

 private:
  assign::Lists before_;
  bool has_before_ = false;
  ListChanges changes_;
};

// What samples of one set found.
struct EvaluatedLights {
  std::string set;
  std::uint64_t evaluated = 0, missed = 0;
};

// One case in a grid.
struct FitSide {
  std::optional<double> pairs_mean;                          // with cells
  std::optional<std::uint64_t> true_pairs, false_positives;  // with cells, where accuracy is checked
  std::optional<ListChanges> list_changes;                   // with cells
  std::uint64_t index_entries = 0, bytes = 0;                // high water
  std::vector<EvaluatedLights> evaluated;                    // where samples are asked for
};

// A case beside the same in the grid that does not follow.
struct FitResult {
  grid::Fit fit;
  grid::Span asked;  // within which slices follow; in the last frame
  GridMoves moves;
  FitSide fitted, unfitted;
};

// The configuration with this grid not following anything.
config::Config without_fit(const config::Config& config, std::size_t grid);

}  // namespace clusterbench::run
