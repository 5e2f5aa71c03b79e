#pragma once
// The history as one HTML page: a chart per series, drawn as in reports.

#include <string>
#include <vector>

#include "report/history/history.h"

namespace clusterbench::report {

// Charts for series that vary; the number of the others. Throws Error if this build has no pages.
std::string history_page(const std::vector<Series>& series, std::size_t entries,
                         const std::vector<std::string>& light_changes = {});

}  // namespace clusterbench::report
