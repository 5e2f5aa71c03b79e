#pragma once
// What samples pay for their lights on a device, as a table.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

// Per scene and grid, one line per structure, set of samples and walk, the cheapest reading of each set and walk first
// (where all have the time of a frame, the first by that); then what exact lists would save. Times of a software device
// are marked and not sorted. "" if no case has a reading.
std::string reading_table(const result::Result& result);

}  // namespace clusterbench::report
