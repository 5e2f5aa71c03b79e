#pragma once
// The plan of a run: the product of a configuration's axes, as cases.

#include <cstdint>
#include <optional>
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

// Which part of a run a plan is (run/shards.h), and what identifies the whole run.
struct PlannedShard {
  std::uint64_t index = 1, count = 1;  // from 1
  std::string sweep;                   // a digest of all that its shards have in common
  std::string filter;                  // that selected its cases; "": none did
  std::string baseline_file = {};      // as this process opens it; "": none
  std::string baseline_sha256 = {};
};

struct Plan {
  std::vector<SceneData> scenes;  // loaded, ranges resolved
  std::vector<GroupPlan> groups;
  std::vector<Skipped> skipped;       // impossible combinations, each with its reason
  std::optional<PlannedShard> shard;  // none: the plan is the whole run

  Plan() = default;
  Plan(Plan&&) = default;
  Plan& operator=(Plan&&) = default;

  std::size_t case_count() const;
};

// Loads the scenes and expands the cases. `filter` (a regular expression in RE2 syntax, "" = all) selects cases by
// name. Sets memory_limit() to the configuration's. Throws Error as load_scenes() does, for a filter that is no regular
// expression, for more than k_most_cases, and if no case is left.
// `files`: for several plans of the same scenes.
Plan make_plan(const config::Config& config, const std::string& filter, SceneFiles* files = nullptr);

}  // namespace clusterbench::run
