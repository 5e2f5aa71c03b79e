#pragma once
// What `size` counts of scenes or a configuration: their frames, as finely as high-water marks need them.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/run_inputs.h"
#include "config/config.h"
#include "report/allocation.h"
#include "run/sweep.h"

namespace clusterbench::cli {

struct SizeCounts {
  config::Config config;
  run::Plan plan;
  nlohmann::ordered_json result;
  std::vector<report::GrownTiles> grown;  // with an engine's own room for lists
};

// Counts all cameras of scenes that name none, without truth and times. Where no frames are asked for, a path is
// sampled 30 times a second, or as often as it has keys if that is more, and less where that would be too much work;
// which it is follows from counts and not from times. Says what it counts, unless `quiet`. Nothing once it is to stop.
// `all_methods`: also those with longer lists than others on the same grid, where nothing names methods. `engine`: ""
// or whose settings are asked for: what is counted is then what the engine asks for, not what its limits make of it
// (size_limits.h), which the settings are to be judged by.
std::optional<SizeCounts> counted_for_size(const RunInputs& inputs, const std::string& filter, bool all_methods,
                                           const std::string& engine, bool quiet);

}  // namespace clusterbench::cli
