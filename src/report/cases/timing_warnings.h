#pragma once
// Reasons to doubt the times of a result, and remedies.

#include <string>
#include <vector>

#include "result/case.h"

namespace clusterbench::report {

// One text per kind of problem, with the worst case: intervals wider than 10 % on either side, times in two groups,
// load by other programs or guests, throttled processors, a device whose clock changed by more than 5 %.
// `without_times`: text on the results that do not depend on times.
std::vector<std::string> timing_doubts(const std::vector<result::Case>& cases,
                                       const std::string& without_times = "count instructions instead (--count)");
// The same as lines that begin with "warning: "; "" without a problem.
std::string timing_warnings(const std::vector<result::Case>& cases);

}  // namespace clusterbench::report
