#include "run/counters/machine_load.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "run/repeated.h"

namespace clusterbench::run {
namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

double own_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// Of all processors; 0 where Linux does not count them.
std::uint64_t throttle_events() {
  std::uint64_t all = 0;
  for (unsigned cpu = 0; cpu < std::thread::hardware_concurrency(); ++cpu) {
    std::ifstream in("/sys/devices/system/cpu/cpu" + std::to_string(cpu) + "/thermal_throttle/core_throttle_count");
    if (std::uint64_t count = 0; in >> count) all += count;
  }
  return all;
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

LoadWatch::LoadWatch() : start_(now()) {}

LoadWatch::Now LoadWatch::now() {
  std::ifstream stat("/proc/stat");
  return {1e-9 * wall_ns(), own_seconds(), processor_time(stat), throttle_events()};
}

Disturbance LoadWatch::so_far() const {
  const Now end = now();
  const double own_s = end.own_s - start_.own_s;
  return {end.wall_s - start_.wall_s, std::max(0.0, end.all.busy_s - start_.all.busy_s - own_s),
          std::max(0.0, end.all.stolen_s - start_.all.stolen_s),
          end.throttled >= start_.throttled ? end.throttled - start_.throttled : 0};
}

}  // namespace clusterbench::run
