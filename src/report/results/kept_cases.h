#pragma once
// A result with a part of its cases.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

// Like keep_cases() of case_filter.h; recomputes the Pareto front, presets' ranks and conclusions for the remaining
// cases.
void keep_cases_and_conclude(result::Result& result, const std::string& filter, const std::string& path);

}  // namespace clusterbench::report
