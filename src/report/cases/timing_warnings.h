#pragma once
// What speaks against the times of a result, and what to try.

#include <string>
#include <vector>

#include "result/case.h"

namespace clusterbench::report {

// One for each kind of doubt, with the worst of the cases: intervals wider than 10 % on either side, times in two
// groups, other programs or guests at work, processors that were too hot. `without_times`: what does without them.
std::vector<std::string> timing_doubts(const std::vector<result::Case>& cases,
                                       const std::string& without_times = "count instructions instead (--count)");
// The same as lines that begin with "warning: "; "" without a doubt.
std::string timing_warnings(const std::vector<result::Case>& cases);

}  // namespace clusterbench::report
