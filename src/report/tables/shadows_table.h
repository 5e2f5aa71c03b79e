#pragma once
// Pairs in shadow, and savings by shared shadow maps, as a table.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

// Per scene and grid: the maps that lights in view need, then one line per method and kind of shadow cull; "" if
// neither was requested.
std::string shadows_table(const result::Result& result);

}  // namespace clusterbench::report
