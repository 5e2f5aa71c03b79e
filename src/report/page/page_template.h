#pragma once
// Pages without results, embedded by the build (cmake/ClusterbenchReportPage.cmake).

#include <string_view>

namespace clusterbench::report {

// HTML with one k_results_mark at the place of the results; empty in a build without the page.
std::string_view page_template();     // of reports
std::string_view history_template();  // of `clusterbench history show`
std::string_view check_template();    // of `clusterbench check --page`
inline constexpr std::string_view k_results_mark = "{{results}}";

// Why this build has no pages; empty if it has them.
std::string_view page_obstacle();

}  // namespace clusterbench::report
