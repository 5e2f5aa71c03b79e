#pragma once
// Processor time used by this process and all others, and the number of thermal slowdowns.

#include <cstdint>
#include <istream>

namespace clusterbench::os {

// Of the whole machine since it started, in seconds. 0 where the system does not count it.
struct ProcessorTime {
  double busy_s = 0.0, stolen_s = 0.0;  // by programs; by other guests of the host
};
ProcessorTime processor_time_now();
// From the first line of a /proc/stat of Linux, which counts hundredths of a second.
ProcessorTime processor_time(std::istream& stat);

// Of this process, all its threads together.
double own_processor_s();

// Of all processors since the machine started; 0 if the system does not count them.
std::uint64_t throttle_events();

}  // namespace clusterbench::os
