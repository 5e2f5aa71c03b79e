#pragma once
// A pre-cull as a configuration asks for it.

#include <nlohmann/json.hpp>

#include "cull/pre_cull_spec.h"

namespace clusterbench::config {

// Of "none", one step, or a list of steps, with all defaults filled in.
cull::PreCullSpec pre_cull_spec(const nlohmann::json& request);
// The same the other way: "none", or a list of steps.
nlohmann::ordered_json pre_cull_request(const cull::PreCullSpec& spec);

}  // namespace clusterbench::config
