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

// better: some cost is lower, and none is higher; values that only follow from it (a histogram, the worst frame) may
// change with it. Any other difference is worse. Values that the other result's version does not record are skipped.
// `is_margin_same`: whether allocation.margin is equal in both; if not, recommended sizes and their used share differ
// because of it, and are skipped.
ExactDifferences exact_differences(const result::Case& base, const result::Case& next, bool is_margin_same = true);

// "frame 5, cell [1,0,2], light 8 ('torch')" of error.deepest; "" without one.
std::string deepest_loss_text(const result::Case& result_case);

}  // namespace clusterbench::report
