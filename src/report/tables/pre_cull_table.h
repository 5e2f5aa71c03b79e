#pragma once
// Lights removed by pre-culls, with their cost and losses, as a table.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

// Per scene and grid: one line per assigner and pre-cull; "" without a cull.
std::string pre_cull_table(const result::Result& result);

}  // namespace clusterbench::report
