#pragma once
// The cost model of a configuration (config.cost) over the cases of a result: measure/frame_cost.h.

#include <nlohmann/json.hpp>

namespace clusterbench::report {

// Gives each case with samples that have a weight its `cost`, anew where it has one. Nothing where the configuration
// has no model: an older result.
void add_costs(nlohmann::ordered_json& cases, const nlohmann::ordered_json& config);

}  // namespace clusterbench::report
