#pragma once
// What slices that follow what frames need save and risk, as a table.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

// One line per case of a grid that follows; "" without any.
std::string fit_table(const result::Result& result);

}  // namespace clusterbench::report
