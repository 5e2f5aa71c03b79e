#pragma once
// The result as JSON: the contract with everything that reads results. Names are stable under a schema_version; what is
// not a number is null.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "run/result.h"

namespace clusterbench::report {

inline constexpr int k_schema_version = 2;

// JSON has no infinity and no NaN.
nlohmann::ordered_json number_or_null(double value);
// Six digits of what is measured: far more than any clock gives.
nlohmann::ordered_json six_digits(double value);

nlohmann::ordered_json tool_to_json(const run::ToolFacts& tool);
nlohmann::ordered_json case_to_json(const run::CaseResult& case_result);

// `earlier_cases`: what an interrupted run had finished, as case_to_json gave it. All cases come in the plan's order.
nlohmann::ordered_json result_to_json(const run::Result& result,
                                      const std::vector<nlohmann::ordered_json>& earlier_cases);

// Per scene the cases that none beats in frame time, list bytes and overshade together, or in what `origin` ranks by
// (run/gate.h), in the order of the cases. `origin`: the result whose configuration they have.
nlohmann::ordered_json fronts(const nlohmann::ordered_json& scenes, const nlohmann::ordered_json& cases,
                              const nlohmann::ordered_json& origin);

// Adds `presets` and `preset_rankings` (report/preset_ranking.h) where cases are of presets.
void add_presets(nlohmann::ordered_json& result, const nlohmann::ordered_json& origin);

// What a run fails for, a line each, as its cases' `failures` say.
std::vector<std::string> gate_failures(const nlohmann::ordered_json& result);

}  // namespace clusterbench::report
