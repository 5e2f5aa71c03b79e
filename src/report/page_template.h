#pragma once
// The page without its results, embedded by the build (cmake/ClusterbenchReportPage.cmake).

#include <string_view>

namespace clusterbench::report {

// HTML with one k_results_mark where the results belong; empty in a build without the page.
std::string_view page_template();
inline constexpr std::string_view k_results_mark = "{{results}}";

// Why this build has no page; empty where it has one.
std::string_view page_obstacle();

}  // namespace clusterbench::report
