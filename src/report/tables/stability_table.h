#pragma once
// Stability of lists over time, as a table.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

// Per scene and grid, one line per assigner, the fewest changes first, and the truth's own; "" if no case has it.
std::string stability_table(const result::Result& result);

}  // namespace clusterbench::report
