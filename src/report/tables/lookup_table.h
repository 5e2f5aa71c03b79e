#pragma once
// Lights missed by the lookup, as a table.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

// Per scene and grid, one line per method, and one per storage or own structure if their misses differ; "" if no case
// has it.
std::string lookup_table(const result::Result& result);

}  // namespace clusterbench::report
