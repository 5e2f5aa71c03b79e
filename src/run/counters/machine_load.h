#pragma once
// What other programs take of the machine while something is measured, and whether it gets too hot.

#include <istream>

#include "run/timing_samples.h"

namespace clusterbench::run {

// Processor time of the whole machine since it started, in seconds: the first line of a /proc/stat.
struct ProcessorTime {
  double busy_s = 0.0, stolen_s = 0.0;  // by programs; by other guests of the host
};
ProcessorTime processor_time(std::istream& stat);

// From its making on.
class LoadWatch {
 public:
  LoadWatch();
  Disturbance so_far() const;

 private:
  struct Now {
    double wall_s = 0.0, own_s = 0.0;
    ProcessorTime all;
    std::uint64_t throttled = 0;
  };
  static Now now();

  Now start_;
};

}  // namespace clusterbench::run
