#include "os/machine.h"

#include <sys/utsname.h>
#include <unistd.h>

#include <fstream>
#include <thread>

namespace clusterbench::os {
namespace {

constexpr const char* k_cpuinfo = "/proc/cpuinfo";

}  // namespace

Machine this_machine() {
  std::ifstream cpuinfo(k_cpuinfo);
  Machine machine;
  machine.processor = processor_of(cpuinfo);
  machine.caches = caches_now();
  machine.cores = static_cast<int>(std::thread::hardware_concurrency());
  machine.ram_bytes =
      static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGE_SIZE));
  utsname names{};
  if (uname(&names) == 0) machine.system = std::string(names.sysname) + " " + names.release + " " + names.machine;
  return machine;
}

std::vector<std::pair<std::string, std::uint64_t>> caches_now() {
  return caches_of("/sys/devices/system/cpu/cpu0/cache");
}

std::optional<Clock> clock_now() {
  std::ifstream cpuinfo(k_cpuinfo);
  return clock_of(cpuinfo, "/sys/devices/system/cpu/cpu0/cpufreq");
}

std::optional<double> load_now() {
  std::ifstream loadavg("/proc/loadavg");
  return load_of(loadavg);
}

}  // namespace clusterbench::os
