#pragma once
// Advice on an inconclusive comparison: no common case, inconclusive verdicts, a program compared with itself.

#include <string>
#include <vector>

#include "result/documents/comparison.h"

namespace clusterbench::report {

// `comparison`: of compare_results(), without its advice. Empty if every verdict is conclusive.
std::vector<std::string> advice_on(const result::Comparison& comparison);

// Why two results have no common case, and the command for the user's probable intention. `base_name`: its file.
std::string advice_on_nothing(const result::Result& base, const result::Result& next, const std::string& base_name,
                              const std::string& next_name);

}  // namespace clusterbench::report
