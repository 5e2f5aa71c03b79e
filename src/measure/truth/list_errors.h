#pragma once
// Comparison of reported lists with true lists.

#include <cstdint>
#include <optional>

#include "measure/truth/truth.h"

namespace clusterbench::measure {

// A missing pair, identified so that a user can inspect it.
struct Miss {
  int frame = 0;
  std::uint32_t cell = 0;
  std::uint32_t light = 0;  // index of the lists
  int rig_index = -1;       // index in Scene::lights
  double depth = 0.0;       // 1 - d/r: how far inside its range the missed light's cell is
};

// excess / true_count: 0 if the excess is 0, NaN if only the true count is 0.
double ratio_to_true(double excess, std::uint64_t true_count);

struct ErrorCounts {
  std::uint64_t true_pairs = 0, reported_pairs = 0, false_positives = 0, false_negatives = 0;
  std::uint64_t filter_decided = 0, exact_decided = 0, undecided = 0;
  int frames_checked = 0;
  double deepest_miss = 0.0;
  std::optional<Miss> deepest;

  double excess_ratio() const;  // FP / true; 0 if no pair is true or reported, NaN if only reported ones exist
  double miss_ratio() const;    // FN / true
};

// Adds one frame's comparison.
void add_frame(ErrorCounts& counts, const view::Frame& frame, const grid::Grid& grid, const Truth& truth,
               const assign::Lists& reported);
// The same for the cells of an occupied subset of a grid.
void add_frame(ErrorCounts& counts, const view::Frame& frame, const grid::OccupiedCells& cells, const Truth& truth,
               const assign::Lists& reported);

}  // namespace clusterbench::measure
