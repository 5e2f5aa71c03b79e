#pragma once
// Reasons to doubt the times of a result, and remedies.

#include <string>
#include <vector>

#include "result/result.h"

namespace clusterbench::report {

// One text per kind of problem of times of the processor, with the worst case: no interval, intervals wider than 10 %
// on either side, times in two groups, load by other programs or guests, throttled processors. `without_times`: text on
// the results that do not depend on times.
std::vector<std::string> timing_doubts(const std::vector<result::Case>& cases,
                                       const std::string& without_times = "count instructions instead (--count)");
// The same and that of a device's times: intervals, and a clock that changed by more than 5 %. Of a software device
// only that its times rank nothing.
std::vector<std::string> timing_doubts(const result::Result& result);
// The latter as lines that begin with "warning: "; "" without a problem.
std::string timing_warnings(const result::Result& result);

}  // namespace clusterbench::report
