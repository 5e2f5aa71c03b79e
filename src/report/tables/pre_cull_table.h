#pragma once
// What pre-culls remove, take and lose, as a table for people.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

// Per scene and grid: one line per assigner and pre-cull; "" where nothing is culled.
std::string pre_cull_table(const result::Result& result);

}  // namespace clusterbench::report
