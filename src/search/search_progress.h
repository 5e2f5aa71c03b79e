#pragma once
// When a search ends, and how far it is; shared by its threads.

#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <string>

#include "search/worst_case.h"

namespace clusterbench::search {

using SearchClock = std::chrono::steady_clock;

// Ends the search early.
class Clockwork {
 public:
  Clockwork(double seconds, const std::atomic<bool>& stop) : stop_(stop) {
    if (seconds > 0.0)
      deadline_ = SearchClock::now() +
                  std::chrono::duration_cast<SearchClock::duration>(std::chrono::duration<double>(seconds));
  }
  // Call it before each evaluation.
  bool is_over() {
    if (!is_over_ && (stop_ || (deadline_ && SearchClock::now() >= *deadline_))) is_over_ = true;
    return is_over_;
  }
  const std::atomic<bool>& over() const { return is_over_; }
  // From any thread; the first reason is kept.
  void fail(const std::string& reason) {
    const std::lock_guard lock(failing_);
    if (!has_failed_) failure_ = reason;
    has_failed_ = is_over_ = true;
  }
  bool has_failed() const { return has_failed_; }
  const std::string& failure() const { return failure_; }  // of threads that have ended
  Ended ended() const {
    if (has_failed_) return Ended::device;
    return stop_ ? Ended::signal : is_over_ ? Ended::seconds : Ended::evaluations;
  }

 private:
  const std::atomic<bool>& stop_;
  std::optional<SearchClock::time_point> deadline_;
  std::atomic<bool> is_over_{false}, has_failed_{false};
  std::mutex failing_;
  std::string failure_;
};

class SearchProgress {
 public:
  SearchProgress(const WorstCaseListener& listener, int whole) : listener_(listener), whole_(whole) {}
  void begin(const std::string& doing) {
    const std::lock_guard lock(mutex_);
    doing_ = doing;
  }
  void step() {
    const std::lock_guard lock(mutex_);
    ++done_;
    if (listener_.on_progress) listener_.on_progress(doing_, done_, whole_);
  }

 private:
  const WorstCaseListener& listener_;
  int whole_;
  std::mutex mutex_;
  std::string doing_;
  int done_ = 0;
};

}  // namespace clusterbench::search
