#pragma once
// What packing lights loses and what inflation costs, as a table for people.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

// Per scene and grid: what each packing loses, then one line per assigner and precision; "" where no light is packed.
std::string precision_table(const result::Result& result);

}  // namespace clusterbench::report
