#pragma once
// Runs something as often as takes some time, the same number of times in every round.

#include <functional>

#include "core/clock.h"

namespace clusterbench::run {

using Clock = double (*)();  // ns since some moment
// The processor time of this thread: knows nothing of other programs that had the processor meanwhile, nor of other
// threads that did the work.
double thread_ns();

class Repeated {
 public:
  Repeated(std::function<void()> once, double min_ns, Clock now_ns = wall_ns)
      : once_(std::move(once)), min_ns_(min_ns), now_ns_(now_ns) {}

  // ns per run.
  double sample();
  // As many runs as a sample has, untimed: caches and branch predictors then know this work, and not the one before.
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
