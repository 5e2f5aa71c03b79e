#pragma once
// The configuration that measures a written path as the search has measured it.

#include <nlohmann/json.hpp>
#include <string>

#include "run/cases/sweep.h"

namespace clusterbench::search {

// Of the configuration that was searched: its case alone, all frames of the scene, no times and no stability, which a
// path of jumps does not have. `scene`: the scene's path as the configuration names it.
nlohmann::ordered_json replay_config(const config::Config& config, const run::CasePlan& case_plan,
                                     const std::string& scene);

// The case of the replay's plan that was searched.
const run::CasePlan& replayed_case(const run::Plan& replay, const run::CasePlan& case_plan);

}  // namespace clusterbench::search
