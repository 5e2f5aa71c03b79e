#include "cli/output/duration.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/text.h"

namespace clusterbench::cli {

// One or two digits: the estimate is not more precise.
std::string duration_text(double seconds) {
  const auto rounded = [](double value, const char* unit) {
    const double step = value < 10.0 ? 1.0 : value < 100.0 ? 5.0 : 50.0;
    return number_of(static_cast<std::uint64_t>(step * std::max(1.0, std::round(value / step))), unit);
  };
  if (seconds < 1.0) return "less than a second";
  return "about " + (seconds < 100.0    ? rounded(seconds, "second")
                     : seconds < 6000.0 ? rounded(seconds / 60.0, "minute")
                                        : rounded(seconds / 3600.0, "hour"));
}

std::string wait_text(const std::string& subject, double seconds, const std::vector<std::string>& shorter) {
  const std::string text = subject + ": takes " + duration_text(seconds);
  return seconds <= k_long_wait_s || shorter.empty() ? text : text + "; shorter: " + joined(shorter);
}

}  // namespace clusterbench::cli
