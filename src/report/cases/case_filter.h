#pragma once
// Selects cases of a result, as --filter of `run` does.

#include <string>

#include "result/result.h"
#include "run/cases/case_names.h"

namespace clusterbench::report {

run::CaseNames names_of_case(const result::Case& result_case);
// Renames cases of earlier versions to their current names.
void use_current_names(result::Result& result);
// By any printed name of the case.
bool is_selected(const Pattern& pattern, const result::Case& result_case);

// Removes all other cases; "": keeps all. Throws Error with an example if no case matches. `path`: name of the result
// in the message.
void keep_cases(result::Result& result, const std::string& filter, const std::string& path);

}  // namespace clusterbench::report
