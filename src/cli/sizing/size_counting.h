#pragma once
// What `size` counts of scenes or a configuration: their frames, as finely as high-water marks need them.

#include <optional>
#include <string>
#include <vector>

#include "cli/options/run_inputs.h"
#include "config/config.h"
#include "report/sizing/allocation.h"
#include "result/result.h"
#include "run/cases/sweep.h"
#include "run/runner.h"

namespace clusterbench::cli {

// What is to be counted.
struct SizePlan {
  config::Config config;
  run::Plan plan;
  std::optional<config::Config> limited;  // of an engine whose settings are asked for: with its own limits
  std::vector<run::GroupCost> costs;      // once somebody was told how long it takes
  bool is_coarser = false;                // than a path has keys, or 30 a second
  bool has_exact_methods = false;         // since nothing names others
};

struct SizeCounts {
  config::Config config;
  run::Plan plan;
  result::Result result;
  std::vector<report::GrownTiles> grown;  // with an engine's own room for lists
};

// All cameras of scenes that name none, without truth and times. Where no frames are asked for, a path is sampled 30
// times a second, or as often as it has keys if that is more, and less where that would be too much work; which it is
// follows from counts and not from times. Nothing once it is to stop.
// `all_methods`: also those with longer lists than others on the same grid, where nothing names methods. `engine`: ""
// or whose settings are asked for: what is counted is then what the engine asks for, not what its limits make of it,
// which the settings are to be judged by.
std::optional<SizePlan> plan_for_size(const RunInputs& inputs, const std::string& filter, bool all_methods,
                                      const std::string& engine);

// What will be counted, about how long that takes, and how to have fewer or more. `then`: what follows it, "" or ",
// then ...".
void tell_of_size(SizePlan& plan, const std::string& then);

// Nothing once it is to stop.
std::optional<SizeCounts> counted_for_size(SizePlan plan, bool quiet);

}  // namespace clusterbench::cli
