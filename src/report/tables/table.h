#pragma once
// A result as a table.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

// Per scene and grid, the cases by frame time (by instructions or excess without timing), with a legend, then the
// stability of lists and the precision of lights if measured, then warnings. At most 132 columns for usual names.
// `colour`: with terminal escapes.
std::string render_table(const result::Result& result, bool colour);

}  // namespace clusterbench::report
