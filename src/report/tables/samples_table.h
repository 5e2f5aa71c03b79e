#pragma once
// What lists cost and lose at sets of samples, as a table for people.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

// Per scene and grid, one line per method, and storage or structure of its own where they answer otherwise; "" where no
// case has sets of samples.
std::string samples_table(const result::Result& result);

}  // namespace clusterbench::report
