#pragma once
// Some of a result's cases, as --filter of `run` names them.

#include <nlohmann/json.hpp>
#include <string>

#include "run/case_names.h"

namespace clusterbench::report {

run::CaseNames names_of_case(const nlohmann::ordered_json& result_case);
// Cases of earlier versions get the names that they have now.
void use_current_names(nlohmann::ordered_json& result);
// By any name that is printed for it.
bool is_selected(const Pattern& pattern, const nlohmann::ordered_json& result_case);

// Leaves only the cases that it selects; "": all. Throws Error with an example where it selects none. `path`: what the
// message calls the result.
void keep_cases(nlohmann::ordered_json& result, const std::string& filter, const std::string& path);

// The same, with the Pareto front, presets' ranks and conclusions of those that are left.
void keep_cases_and_conclude(nlohmann::ordered_json& result, const std::string& filter, const std::string& path);

}  // namespace clusterbench::report
