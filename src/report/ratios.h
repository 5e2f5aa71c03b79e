#pragma once
// How much longer one method takes than another. Cases of one scene, camera, viewport and grid are measured in the same
// rounds, and so any two of them have a ratio, round by round, that is far steadier than their times.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "measure/time_statistics.h"

namespace clusterbench::report {

// Frame time of `one` / that of `other`; nullopt where they have no rounds in common.
std::optional<measure::Ratio> ratio_of_cases(const nlohmann::ordered_json& result, const nlohmann::ordered_json& one,
                                             const nlohmann::ordered_json& other);

// False unless the ratio says that `one` takes longer than `other`, with 95 % certainty.
bool takes_longer(const nlohmann::ordered_json& result, const nlohmann::ordered_json& one,
                  const nlohmann::ordered_json& other);

// Of cases whose method's name matches (all: empty) a ranking per grid: each beside the fastest and beside the one
// before it; with `all_pairs` each beside each that is faster. "" where nothing is timed.
std::string ratio_table(const nlohmann::ordered_json& result, const std::string& methods, bool all_pairs);

// All pairs of a grid, both ways around: scene, block, both methods, ratio and interval.
std::string ratio_csv(const nlohmann::ordered_json& result, const std::string& methods);

}  // namespace clusterbench::report
