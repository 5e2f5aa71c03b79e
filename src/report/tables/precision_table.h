#pragma once
// Losses by packed lights and cost of their inflation, as a table.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

// Per scene and grid: the losses of each packing, then one line per assigner and precision; "" without packed lights.
std::string precision_table(const result::Result& result);

}  // namespace clusterbench::report
