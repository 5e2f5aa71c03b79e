#pragma once
// The history as one page for a browser: a chart per series, drawn as those of reports are.

#include <string>
#include <vector>

#include "report/history/history.h"

namespace clusterbench::report {

// Charts for the series that vary; the others are counted. Throws Error if this build has no pages.
std::string history_page(const std::vector<Series>& series, std::size_t entries,
                         const std::vector<std::string>& light_changes = {});

}  // namespace clusterbench::report
