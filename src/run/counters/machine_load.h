#pragma once
// What other programs take of the machine while something is measured, and whether it gets too hot.

#include "os/processor_time.h"
#include "run/timing/timing_samples.h"

namespace clusterbench::run {

// From its making on.
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
