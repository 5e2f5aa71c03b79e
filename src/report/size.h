#pragma once
// What to allocate for the lists: the semi-conservative scheme of Persson 2015. Record the worst ever seen, add a
// margin, assert when it is exceeded and warn before.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace clusterbench::report {

struct SizeRequest {
  std::string filter;  // a regular expression as RE2 has them, "" = all: only cases whose name matches
  // Every case, and constants named by it. Without: of each scene, camera and grid one case that loses no light, and
  // constants that keep their names if that becomes another method. It is the fastest, or of those that the interval of
  // their ratio does not call slower the smallest, so that noise seldom decides; the smallest where nothing was timed.
  bool all = false;
  std::string format = "cpp";  // one of size_formats()
};

// C++, the languages of shaders, and for other programs JSON.
std::vector<std::string> size_formats();

// In C++ a header: for each case, as a comment, the high-water mark and the frame and cell that made it, its share of
// the theoretical maximum, recommended capacity, warning level and bytes; below it the constants; at the end the
// run-time check. In a shader's language the same without the check. Throws Error if the filter is no regex or matches
// no case.
std::string size_report(const nlohmann::ordered_json& result, const SizeRequest& request);

}  // namespace clusterbench::report
