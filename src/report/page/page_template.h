#pragma once
// Pages without their results, embedded by the build (cmake/ClusterbenchReportPage.cmake).

#include <string_view>

namespace clusterbench::report {

// HTML with one k_results_mark where the results belong; empty in a build without the page.
std::string_view page_template();     // of reports
std::string_view history_template();  // of `clusterbench history show`
inline constexpr std::string_view k_results_mark = "{{results}}";

// Why this build has no pages; empty where it has them.
std::string_view page_obstacle();

}  // namespace clusterbench::report
