#pragma once
// Checks a result against its budgets: `limits.fail_if` of its configuration.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/limit_rules.h"
#include "result/result.h"

namespace clusterbench::report {

class BaselineCases;

// Lines with case, figure and, if known, frame and cell.
struct LimitFindings {
  std::vector<std::string> broken;     // includes budgets that could not be checked because no case has the figure
  std::vector<std::string> near;       // less than 10 % away
  std::vector<std::string> unchecked;  // budgets for all cases, with a figure that some cases do not have
  std::vector<std::string> warnings;   // reasons to doubt budgets that hold
  std::size_t checked = 0;             // number of checks of a budget for a case
};
// `baseline`: the baseline of relative budgets; null: none, and they fail.
LimitFindings limit_findings(const result::Result& result, std::span<const config::LimitRule> rules,
                             const BaselineCases* baseline = nullptr);

}  // namespace clusterbench::report
