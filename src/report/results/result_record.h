#pragma once
// The result of a run (result/result.h), with what is concluded from its cases. As JSON it is the contract with
// everything that reads results: names are stable under a schema_version; what is not a number is null.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "result/result.h"
#include "run/findings/run_result.h"

namespace clusterbench::report {

inline constexpr int k_schema_version = 2;

// `earlier_cases`: what an interrupted run had finished. All cases come in the plan's order.
result::Result record_of(const run::Result& result, const std::vector<result::Case>& earlier_cases);

// Per scene the cases that none beats in frame time, list bytes and overshade together, or in what `origin` ranks by
// (run/findings/gate.h), in the order of the cases. `origin`: the result whose configuration they have.
std::vector<result::Front> fronts(const std::vector<result::Scene>& scenes, const std::vector<result::Case>& cases,
                                  const result::Result& origin);

// Adds `presets` and `preset_rankings` (report/presets/preset_ranking.h) where cases are of presets.
void add_presets(result::Result& result, const result::Result& origin);

}  // namespace clusterbench::report
