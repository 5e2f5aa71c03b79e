#pragma once
// The history as one page for a browser: a small chart per series, no script, light or dark as the reader has it.

#include <string>
#include <vector>

#include "report/history.h"

namespace clusterbench::report {

// Charts for the series that vary; the others are counted.
std::string history_page(const std::vector<Series>& series, std::size_t entries);

}  // namespace clusterbench::report
