#pragma once
// How stable lists are over time, as a table for people.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

// Per scene and grid, one line per assigner, the fewest changes first, and the truth's own; "" where no case has it.
std::string stability_table(const result::Result& result);

}  // namespace clusterbench::report
