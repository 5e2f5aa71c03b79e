#pragma once
// Counting for `size`, from scenes or a configuration: frames sampled as finely as high-water marks need.

#include <optional>
#include <string>
#include <vector>

#include "cli/options/run_inputs.h"
#include "config/config.h"
#include "report/sizing/sized_structure.h"
#include "result/result.h"
#include "run/cases/plan.h"
#include "run/runner.h"

namespace clusterbench::cli {

// The input of a count.
struct SizePlan {
  config::Config config;
  run::Plan plan;
  // for an engine whose settings are requested: the plan's configuration with the engine's limits
  std::optional<config::Config> limited;
  std::vector<run::GroupCost> costs;  // set when the duration is printed
  bool is_coarser = false;            // than a path's keys, or than 30 frames a second
  bool has_exact_methods = false;     // since the input names no methods
};

struct SizeCounts {
  config::Config config;
  run::Plan plan;
  result::Result result;
  std::vector<report::GrownTiles> grown;  // with an engine's own room for lists
};

// Plans all cameras of scenes that name none, without truth and times; with samples only where they can decide which of
// several structures of a grid loses no light. If no frames are requested, a path is sampled 30 times a second, at the
// rate of its keys if that is higher, and at a lower rate if that would be too much work; the choice depends on counts,
// not on times. nullopt if stopped. `all_methods`: if the input names no methods, also use those with longer lists than
// others on the same grid. `engine`: "", or the engine whose settings are requested: then the counts are the engine's
// needs without its limits, since the settings are sized from them.
std::optional<SizePlan> plan_for_size(const RunInputs& inputs, const std::string& filter, bool all_methods,
                                      const std::string& engine);

// Prints the planned counting, its estimated duration, and flags for fewer or more frames. `then`: text for the next
// step, "" or ", then ...".
void print_planned_counting(SizePlan& plan, const std::string& then);

// nullopt if stopped.
std::optional<SizeCounts> counted_for_size(SizePlan plan, bool quiet);

}  // namespace clusterbench::cli
