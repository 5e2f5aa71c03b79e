#pragma once
// A pre-cull in the format of a configuration, and back.

#include <nlohmann/json.hpp>

#include "cull/pre_cull_spec.h"

namespace clusterbench::config {

// `request`: "none", one step, or a list of steps, with all defaults filled in.
cull::PreCullSpec pre_cull_spec(const nlohmann::json& request);
// The inverse: "none", or a list of steps.
nlohmann::ordered_json pre_cull_request(const cull::PreCullSpec& spec);

}  // namespace clusterbench::config
