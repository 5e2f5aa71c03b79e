#pragma once
// One frame cell by cell: the data for a picture of its lists, or for the inspection of a single cell.

#include <cstdint>
#include <vector>

#include "assign/contract/lists.h"

namespace clusterbench::measure {

// Whether a pair (cell, light) is in both lists, only reported, or only true.
enum class PairMark : std::uint8_t { both = 0, false_positive = 1, false_negative = 2 };

struct FrameDetails {
  // Cells with a reported or a true light, ascending, and the list lengths of each.
  std::vector<std::uint32_t> cells, reported, truth, false_positives, false_negatives;
  // All pairs of these cells, cell after cell, lights ascending within a cell: reported + false_negatives of each.
  std::vector<std::uint32_t> pair_lights;
  std::vector<std::uint32_t> pair_marks;  // PairMark
  std::vector<std::uint32_t> lights;      // lights in any pair, ascending
};

// Both lists must have the same cells.
FrameDetails find_details(const assign::Lists& truth, const assign::Lists& reported);

}  // namespace clusterbench::measure
