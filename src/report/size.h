#pragma once
// What to allocate for the lists: the semi-conservative scheme of Persson 2015. Record the worst ever seen, add a
// margin, assert when it is exceeded and warn before.

#include <nlohmann/json.hpp>
#include <string>

namespace clusterbench::report {

// A C++ header: for each case, as a comment, the high-water mark and the frame and cell that made it, its share of the
// theoretical maximum, recommended capacity, warning level and bytes; below it the constants; at the end the run-time
// check.
std::string size_report(const nlohmann::ordered_json& result);

}  // namespace clusterbench::report
