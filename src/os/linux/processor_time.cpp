#include "os/processor_time.h"

#include <sys/resource.h>

#include <fstream>
#include <string>
#include <thread>

namespace clusterbench::os {
namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

ProcessorTime processor_time_now() {
  std::ifstream stat("/proc/stat");
  return processor_time(stat);
}

double own_processor_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::uint64_t throttle_events() {
  std::uint64_t all = 0;
  for (unsigned cpu = 0; cpu < std::thread::hardware_concurrency(); ++cpu) {
    std::ifstream in("/sys/devices/system/cpu/cpu" + std::to_string(cpu) + "/thermal_throttle/core_throttle_count");
    if (std::uint64_t count = 0; in >> count) all += count;
  }
  return all;
}

}  // namespace clusterbench::os
