#pragma once
// Counted values of the same case in two results (no times): every number, string and list that differs. Each field
// lists its meaning for the comparison (result::Compares).

#include <optional>
#include <string>
#include <vector>

#include "result/documents/comparison.h"

namespace clusterbench::report {

struct ExactDifferences {
  std::string counts;  // same, better, worse
  std::vector<result::Difference> differences;
  std::optional<std::string> place;  // of the deepest lost light, if the new result loses more
};

// Settings that no case's id depends on; where results differ in one, the figures that follow from it are skipped.
struct SameSettings {
  bool margin = true;   // allocation.margin: the recommended sizes and their used share
  bool prices = true;   // any of cost: the modelled times of a frame
  bool waves = true;    // cost.wave: the divergence as well
  bool weights = true;  // cost.weights: all that is recorded of the cost, which is of other sets of samples
};

// better: some cost is lower, and none is higher; values that only follow from it (a histogram, the worst frame) may
// change with it. Any other difference is worse. Values that the other result's version does not record are skipped.
ExactDifferences exact_differences(const result::Case& base, const result::Case& next, const SameSettings& same = {});

// "frame 5, cell [1,0,2], light 8 ('torch')" of error.deepest; "" without one.
std::string deepest_loss_text(const result::Case& result_case);

}  // namespace clusterbench::report
