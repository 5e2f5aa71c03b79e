#pragma once
// A result held against its budgets: `limits.fail_if` of its configuration.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/limit_rules.h"
#include "result/result.h"

namespace clusterbench::report {

class BaselineCases;

// Lines with case, figure and, where they are known, frame and cell.
struct LimitFindings {
  std::vector<std::string> broken;     // also a budget that could not be checked: about what no case has
  std::vector<std::string> near;       // less than 10 % away
  std::vector<std::string> unchecked;  // budgets of all cases, about what some do not have
  std::vector<std::string> warnings;   // what else has to be known before a budget that holds is believed
  std::size_t checked = 0;             // how often a budget was held against a case
};
// `baseline`: what relative budgets are held against; null: there is none, and they fail.
LimitFindings limit_findings(const result::Result& result, std::span<const config::LimitRule> rules,
                             const BaselineCases* baseline = nullptr);

}  // namespace clusterbench::report
