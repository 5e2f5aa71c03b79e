#pragma once
// Processor time that other programs use during a measurement, and thermal throttling.

#include "os/processor_time.h"
#include "run/timing/timing_samples.h"

namespace clusterbench::run {

// Counts from its construction on.
class LoadWatch {
 public:
  LoadWatch();
  Disturbance so_far() const;

 private:
  struct Now {
    double wall_s = 0.0, own_s = 0.0;
    os::ProcessorTime all;
    std::uint64_t throttled = 0;
  };
  static Now now();

  Now start_;
};

}  // namespace clusterbench::run
