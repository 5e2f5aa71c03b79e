#pragma once
// The plan of a run: the product of a configuration's axes, as cases.

#include <string>
#include <vector>

#include "config/config.h"
#include "run/cases/case_plan.h"
#include "run/cases/scene_data.h"

namespace clusterbench::run {

// Of one run, with those that are skipped. A result with as many would have half a gigabyte.
inline constexpr std::size_t k_most_cases = 100'000;

struct Skipped {
  std::string name, reason;
  bool is_other_kind = false;  // the method does not support this kind of grid
  std::string preset = {};     // "" for the configuration's own clusterings
};

struct Plan {
  std::vector<SceneData> scenes;  // loaded, ranges resolved
  std::vector<GroupPlan> groups;
  std::vector<Skipped> skipped;  // impossible combinations, each with its reason

  Plan() = default;
  Plan(Plan&&) = default;
  Plan& operator=(Plan&&) = default;

  std::size_t case_count() const;
};

// Loads the scenes and expands the cases. `filter` (a regular expression in RE2 syntax, "" = all) selects cases by
// name. Sets memory_limit() to the configuration's. Throws Error as load_scenes() does, for a filter that is no regular
// expression, for more than k_most_cases, and if no case is left.
Plan make_plan(const config::Config& config, const std::string& filter);

}  // namespace clusterbench::run
