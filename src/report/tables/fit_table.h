#pragma once
// Savings and risks of slices that follow the needs of frames, as a table.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

// One line per case with a grid that follows; "" without any.
std::string fit_table(const result::Result& result);

}  // namespace clusterbench::report
