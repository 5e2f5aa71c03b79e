#pragma once
// One frame cell by cell: what a picture of its lists, or a look into a single cell, needs.

#include <cstdint>
#include <vector>

#include "assign/contract/lists.h"

namespace clusterbench::measure {

// How a pair (cell, light) stands.
enum class PairMark : std::uint8_t { both = 0, false_positive = 1, false_negative = 2 };

struct FrameDetails {
  // Cells that have a reported or a true light, ascending, and beside each its list lengths.
  std::vector<std::uint32_t> cells, reported, truth, false_positives, false_negatives;
  // All pairs of these cells, cell after cell, lights ascending within a cell: reported + false_negatives of each.
  std::vector<std::uint32_t> pair_lights;
  std::vector<std::uint32_t> pair_marks;  // PairMark
  std::vector<std::uint32_t> lights;      // that are in any pair, ascending
};

// Both lists have the same cells.
FrameDetails find_details(const assign::Lists& truth, const assign::Lists& reported);

}  // namespace clusterbench::measure
