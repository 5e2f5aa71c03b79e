#pragma once
// A result held against its budgets: `limits.fail_if` of its configuration.

#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/limit_rules.h"

namespace clusterbench::report {

// A figure of a case by its name in budgets (config/limit_rules.h); nothing where the case has none.
std::optional<double> limit_figure(const nlohmann::ordered_json& result_case, const std::string& name);

// Lines with case, figure and, where they are known, frame and cell.
struct LimitFindings {
  std::vector<std::string> broken;  // also a budget about what no case has: it could not be checked
  std::vector<std::string> near;    // less than 10 % below
  // Budgets about what some cases do not have.
  std::vector<std::string> unchecked;
};
LimitFindings limit_findings(const nlohmann::ordered_json& result, std::span<const config::LimitRule> rules);

}  // namespace clusterbench::report
