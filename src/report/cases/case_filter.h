#pragma once
// Some of a result's cases, as --filter of `run` names them.

#include <string>

#include "result/result.h"
#include "run/cases/case_names.h"

namespace clusterbench::report {

run::CaseNames names_of_case(const result::Case& result_case);
// Cases of earlier versions get the names that they have now.
void use_current_names(result::Result& result);
// By any name that is printed for it.
bool is_selected(const Pattern& pattern, const result::Case& result_case);

// Leaves only the cases that it selects; "": all. Throws Error with an example where it selects none. `path`: what the
// message calls the result.
void keep_cases(result::Result& result, const std::string& filter, const std::string& path);

}  // namespace clusterbench::report
