#pragma once
// Warnings of a comparison: parts that were not compared, and how certain times are.

#include <string>
#include <vector>

#include "result/documents/comparison.h"
#include "result/result.h"

namespace clusterbench::report {

// `comparison`: complete except for warnings and advice. `forced`: obstacles that the user overrides. `is_beside`: one
// result, compared with its baseline program. `gates_separate`: times of separate runs have verdicts.
std::vector<std::string> warnings_of(const result::Result& base, const result::Result& next,
                                     const result::Comparison& comparison, bool is_beside,
                                     const std::vector<std::string>& forced, bool gates_separate);

}  // namespace clusterbench::report
