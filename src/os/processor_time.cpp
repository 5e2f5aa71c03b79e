#include "os/processor_time.h"

#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#include <string>
#include <thread>

namespace clusterbench::os {
namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

ProcessorTime processor_time(std::istream& stat) {
  const auto ticks_per_s = static_cast<double>(sysconf(_SC_CLK_TCK));
  std::string name;
  double user = 0, nice = 0, system = 0, idle = 0, waiting = 0, irq = 0, soft_irq = 0, stolen = 0;
  stat >> name >> user >> nice >> system >> idle >> waiting >> irq >> soft_irq >> stolen;
  if (!stat || name != "cpu") return {};
  return {(user + nice + system + irq + soft_irq) / ticks_per_s, stolen / ticks_per_s};
}

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
