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

// A line with an estimate of the time left (by cost, not by count) on a terminal, else a line per finished case, and
// one with the estimate where nothing else was told for ten seconds, however long a step takes.
class ProgressLine {
 public:
  ProgressLine(os::Terminal terminal, bool quiet, std::chrono::milliseconds tell_every = std::chrono::seconds(10));
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const run::Progress& progress);
  // What begins: a line where none can be redrawn.
  void stage(const std::string& what);
  void case_done(const run::CaseResult& done, std::size_t number, std::size_t total);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  std::string line() const;
  void tell_line(const std::string& line);
  void tell_in_silence(const std::stop_token& stop);

  os::Terminal terminal_;
  bool quiet_;
  std::chrono::milliseconds tell_every_;
  bool drawn_ = false;
  Clock::time_point start_ = Clock::now(), drawn_at_{};

  std::mutex mutex_;  // of what follows
  std::condition_variable_any changed_;
  run::Progress last_;
  bool has_last_ = false;                     // and it is still going on
  Clock::time_point told_at_ = Clock::now();  // a line that stays
  std::jthread teller_;                       // where no line can be redrawn
};

}  // namespace clusterbench::cli
