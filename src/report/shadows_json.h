#pragma once
// What shadows say about a case's lists and maps, as the result has it.

#include <nlohmann/json.hpp>

#include "run/result.h"

namespace clusterbench::report {

// `shadows` of a case: shadow_cull, one entry per way, and shadow_frusta; only what was asked for.
nlohmann::ordered_json shadows_to_json(const run::CaseResult& case_result);
// `shadow_cull` of a case's timing, one entry per way.
nlohmann::ordered_json shadow_times_to_json(const std::vector<run::ShadowCullResult>& culls);

}  // namespace clusterbench::report
