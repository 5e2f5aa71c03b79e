#pragma once
// Tiles that react and storages whose room ends, as tables.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

// One line per case that reacts, or whose storage can run out of room; "" without any.
std::string reaction_table(const result::Result& result);
std::string fallback_table(const result::Result& result);

}  // namespace clusterbench::report
