#pragma once
// The estimated duration of a command, printed before it starts. ProgressLine (progress_line.h) shows the remaining
// time.

#include <string>
#include <vector>

namespace clusterbench::cli {

// "about 4 minutes", "less than a second".
std::string duration_text(double seconds);

// A longer command names the flags that shorten it: runs with default settings should end within this time on two
// cores.
inline constexpr double k_long_wait_s = 120.0;

// "24 cases: takes about 4 minutes; shorter: --no-timing (about 2 minutes), --rounds 5". `shorter`: flags, printed only
// for a long command.
std::string wait_text(const std::string& subject, double seconds, const std::vector<std::string>& shorter);

}  // namespace clusterbench::cli
