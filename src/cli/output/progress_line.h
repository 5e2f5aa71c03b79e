#pragma once
// The progress of a run on standard error.

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>

#include "os/terminal.h"
#include "run/runner.h"

namespace clusterbench::cli {

// On a terminal, a line with an estimate of the remaining time (by cost, not by count). Otherwise a line per finished
// case, and a line with the estimate after ten seconds without output, even during a long step.
class ProgressLine {
 public:
  ProgressLine(os::Terminal terminal, bool quiet, std::chrono::milliseconds print_every = std::chrono::seconds(10));
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const run::Progress& progress);
  // The name of a new stage: printed as a line if the output is not a terminal.
  void stage(const std::string& name);
  void case_done(const run::CaseResult& done, std::size_t number, std::size_t total);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  std::string line() const;
  void print_line(const std::string& line);
  void print_when_silent();

  os::Terminal terminal_;
  bool quiet_;
  std::chrono::milliseconds print_every_;
  bool drawn_ = false;
  Clock::time_point start_ = Clock::now(), drawn_at_{};

  std::mutex mutex_;  // for the members below
  std::condition_variable ended_;
  bool has_ended_ = false;
  run::Progress last_;
  bool has_last_ = false;                        // a step is in progress
  Clock::time_point printed_at_ = Clock::now();  // time of the last permanent line
  std::thread printer_;                          // only if the output is not a terminal; libc++ has no std::jthread
};

}  // namespace clusterbench::cli
