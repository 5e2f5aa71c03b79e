#pragma once
// Cost and losses of lists at sets of samples, as a table.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

// Per scene and grid, one line per method, and one per storage or own structure if their answers differ; "" if no case
// has sets of samples.
std::string samples_table(const result::Result& result);

}  // namespace clusterbench::report
