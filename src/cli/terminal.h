#pragma once
// What a terminal can show, and the progress of a run on standard error.

#include <chrono>
#include <cstdint>
#include <string>

#include "run/runner.h"

namespace clusterbench::cli {

struct Terminal {
  bool interactive = false;  // can redraw a line
  bool colour = false;       // a terminal, and neither NO_COLOR nor TERM=dumb
  int columns = 80;
};
Terminal terminal(int stream);  // STDERR_FILENO, STDOUT_FILENO

// A line with an estimate of the time left (by cost, not by count) on a terminal, else a line per finished case, and
// one with the estimate where nothing else was told for ten seconds.
class ProgressLine {
 public:
  ProgressLine(Terminal terminal, bool quiet) : terminal_(terminal), quiet_(quiet) {}
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const run::Progress& progress);
  // What begins: a line where none can be redrawn.
  void stage(const std::string& what);
  void case_done(const run::CaseResult& done, std::size_t number, std::size_t total);
  void clear();

 private:
  Terminal terminal_;
  bool quiet_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point drawn_at_{};
  std::chrono::steady_clock::time_point told_at_ = std::chrono::steady_clock::now();  // a line that stays
};

}  // namespace clusterbench::cli
