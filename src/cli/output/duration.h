#pragma once
// How long a command is about to take, which it says before somebody waits for it. What is left is told by ProgressLine
// (progress_line.h).

#include <string>
#include <vector>

namespace clusterbench::cli {

// "about 4 minutes", "less than a second".
std::string duration_text(double seconds);

// Beyond it a command says what makes it shorter: runs that nobody set up are to end within it on two cores.
inline constexpr double k_patience_s = 120.0;

// "24 cases: takes about 4 minutes; shorter: --no-timing (about 2 minutes), --rounds 5". `shorter`: flags, told where
// somebody would have to be patient.
std::string wait_text(const std::string& what, double seconds, const std::vector<std::string>& shorter);

}  // namespace clusterbench::cli
