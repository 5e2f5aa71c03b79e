#pragma once
// What `size` counts of scenes or a configuration: their frames, as finely as high-water marks need them.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "cli/run_inputs.h"
#include "config/config.h"
#include "run/sweep.h"

namespace clusterbench::cli {

struct SizeCounts {
  config::Config config;
  run::Plan plan;
  nlohmann::ordered_json result;
};

// Counts all cameras of scenes that name none, without truth and times. Where no frames are asked for, a path is
// sampled 30 times a second, or as often as it has keys if that is more, and less where that would be too much work;
// which it is follows from counts and not from times. Says what it counts, unless `quiet`. Nothing once it is to stop.
// `all_methods`: also those with longer lists than others on the same grid, where nothing names methods. `engine`: ""
// or whose settings are asked for: lists are then those of all lights that its culling leaves, not those behind its
// limit on their number, which the settings are to be judged by.
std::optional<SizeCounts> counted_for_size(const RunInputs& inputs, const std::string& filter, bool all_methods,
                                           const std::string& engine, bool quiet);

}  // namespace clusterbench::cli
