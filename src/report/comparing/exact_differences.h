#pragma once
// What is counted rather than timed, of the same case in two results: every number, string and list that is not equal.
// What that means of each field is said where it is listed (result::Compares).

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

// better: something costs less, and nothing costs more; what only follows from that (a histogram, the worst frame) may
// change with it. Any other difference is worse. What one result has and the other's version does not know is passed
// over.
// `is_margin_same`: allocation.margin of both; else what is recommended, and its used share, differ by that setting and
// are passed over.
ExactDifferences exact_differences(const result::Case& base, const result::Case& next, bool is_margin_same = true);

// "frame 5, cell [1,0,2], light 8 ('torch')" of error.deepest; "" without one.
std::string deepest_loss_text(const result::Case& result_case);

}  // namespace clusterbench::report
