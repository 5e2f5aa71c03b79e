#pragma once
// The result of a run (result/result.h), with the conclusions from its cases. As JSON it is the interface to all
// readers of results: names are stable under a schema_version; NaN is null.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "result/result.h"
#include "run/findings/run_result.h"

namespace clusterbench::report {

inline constexpr int k_schema_version = 2;

// `earlier_cases`, `earlier_broken`: those of an interrupted run. All cases are in the plan's order. A finished case
// that broke afterwards, as its plug-in was unloaded, is among the cases, with a failure. A shard has no fronts, ranks
// and conclusions: they are of all cases, and merged() draws them. `threads` share the cases.
result::Result record_of(const run::Result& result, const std::vector<result::Case>& earlier_cases,
                         const std::vector<result::BrokenCase>& earlier_broken = {}, int threads = 1);

// Per scene the Pareto front in frame time, list bytes and overshade, or in the costs that `origin` ranks by
// (run/findings/gate.h), in the order of the cases. `origin`: the result with their configuration.
std::vector<result::Front> fronts(const std::vector<result::Scene>& scenes, const std::vector<result::Case>& cases,
                                  const result::Result& origin);

// Adds `presets` and `preset_rankings` (report/presets/preset_ranking.h) if cases belong to presets.
void add_presets(result::Result& result, const result::Result& origin);

}  // namespace clusterbench::report
