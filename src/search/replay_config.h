#pragma once
// The configuration that measures a written path as the search has measured it.

#include <nlohmann/json.hpp>
#include <string>

#include "run/cases/plan.h"

namespace clusterbench::search {

// Made from the searched configuration: only its case, all frames of the scene, no times and no stability, which a path
// with jumps does not have. `scene`: the scene's path in the configuration.
nlohmann::ordered_json replay_config(const config::Config& config, const run::CasePlan& case_plan,
                                     const std::string& scene);

// The case of the replay's plan that corresponds to the searched one.
const run::CasePlan& replayed_case(const run::Plan& replay, const run::CasePlan& case_plan);

}  // namespace clusterbench::search
