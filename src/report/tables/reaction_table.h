#pragma once
// Tiles that react, and storages that can be full, as tables.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

// One line per case that reacts, or whose storage can be full; "" without any.
std::string reaction_table(const result::Result& result);
std::string fallback_table(const result::Result& result);

}  // namespace clusterbench::report
