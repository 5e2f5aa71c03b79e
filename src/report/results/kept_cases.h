#pragma once
// A result of some of its cases.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

// As keep_cases() of case_filter.h, with the Pareto front, presets' ranks and conclusions of those that are left.
void keep_cases_and_conclude(result::Result& result, const std::string& filter, const std::string& path);

}  // namespace clusterbench::report
