#pragma once
// What to do about a comparison that does not answer: nothing in common, verdicts that are inconclusive, a program
// beside itself.

#include <string>
#include <vector>

#include "result/documents/comparison.h"

namespace clusterbench::report {

// Of what compare_results() gives, but for its advice; none where every verdict stands.
std::vector<std::string> advice_on(const result::Comparison& comparison);

// Why two results have no case in common, and which command answers the question behind it. `base_name`: its file.
std::string advice_on_nothing(const result::Result& base, const result::Result& next, const std::string& base_name,
                              const std::string& next_name);

}  // namespace clusterbench::report
