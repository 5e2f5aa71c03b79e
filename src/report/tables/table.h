#pragma once
// A result as a table for people.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

// Per scene and grid, the cases by frame time (by instructions or excess where nothing was timed), with a legend, then
// the stability of lists and the precision of lights where they were measured, then warnings. At most 132 columns for
// usual names. `colour`:
// with terminal escapes.
std::string render_table(const result::Result& result, bool colour);

}  // namespace clusterbench::report
