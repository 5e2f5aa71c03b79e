#pragma once
// What the lookup misses, as a table for people.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

// Per scene and grid, one line per method, and storage or structure of its own where they miss otherwise; "" where no
// case has it.
std::string lookup_table(const result::Result& result);

}  // namespace clusterbench::report
