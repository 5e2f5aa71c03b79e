#pragma once
// What lies in shadow, and what sharing shadow maps saves, as a table for people.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

// Per scene and grid: the maps that lights in view need, then one line per method and way to take out what lies in
// shadow; "" where neither was asked for.
std::string shadows_table(const result::Result& result);

}  // namespace clusterbench::report
