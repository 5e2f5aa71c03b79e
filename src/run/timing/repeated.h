#pragma once
// Runs a piece of work often enough for a minimum time, the same number of times in every round.

#include <functional>

#include "core/clock.h"

namespace clusterbench::run {

using Clock = double (*)();  // ns since some moment
// The processor time of this thread: it excludes time in which other programs had the processor, and the work of other
// threads.
double thread_ns();

class Repeated {
 public:
  Repeated(std::function<void()> once, double min_ns, Clock now_ns = wall_ns)
      : once_(std::move(once)), min_ns_(min_ns), now_ns_(now_ns) {}

  // ns per run.
  double sample();
  // As many runs as a sample has, untimed: caches and branch predictors then fit this work, not the previous one.
  void warm_up();
  // In one sample; 0 before the first.
  int runs_per_sample() const { return repeats_; }

 private:
  void calibrate();

  std::function<void()> once_;
  double min_ns_;
  Clock now_ns_;
  int repeats_ = 0;
};

}  // namespace clusterbench::run
