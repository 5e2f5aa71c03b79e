#include "os/hardware_counter.h"

#include <linux/perf_event.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>

#include "core/error.h"

namespace clusterbench::os {
namespace {

// A pinned leader counts all of the time or fails; without it the kernel would share the counter and estimate.
int open_event(std::uint32_t type, std::uint64_t event, int leader) {
  perf_event_attr attr{};
  attr.size = sizeof attr;
  attr.type = type;
  attr.config = event;
  attr.disabled = attr.pinned = leader < 0 ? 1 : 0;
  attr.exclude_kernel = attr.exclude_hv = 1;
  attr.read_format = PERF_FORMAT_GROUP;
  return static_cast<int>(syscall(SYS_perf_event_open, &attr, 0, -1, leader, PERF_FLAG_FD_CLOEXEC));
}

std::string refusal(int number) {
  switch (number) {
    case ENOENT:
    case ENODEV:
    case EOPNOTSUPP:
      return "this machine shows no hardware counter for it (many virtual machines show none)";
    case EACCES:
    case EPERM: {
      std::string level = "unknown";
      std::ifstream("/proc/sys/kernel/perf_event_paranoid") >> level;
      return "the kernel does not allow it: kernel.perf_event_paranoid is " + level +
             ", at most 2 allows it; a container also has to let perf_event_open through (capability PERFMON)";
    }
    case ENOSYS:
      return "this kernel has no perf_event_open";
    default:
      return std::string("perf_event_open: ") + std::strerror(number);
  }
}

}  // namespace

void HardwareCounter::refuse(const std::string& reason) const {
  throw Error("", location_, reason);
}

HardwareCounter::HardwareCounter(const char* location, std::uint32_t type, std::uint64_t event)
    : location_(location), leader_(open_event(type, event, -1)) {
  if (leader_ < 0) refuse(refusal(errno));
}

HardwareCounter::HardwareCounter(const char* location)
    : HardwareCounter(location, PERF_TYPE_HARDWARE, PERF_COUNT_HW_INSTRUCTIONS) {
  cycles_ = open_event(PERF_TYPE_HARDWARE, PERF_COUNT_HW_CPU_CYCLES, leader_);
  if (is_alive()) return;
  close_cycles();
  if (!is_alive()) refuse("the hardware counter stands still; another program may hold it");
}

HardwareCounter::~HardwareCounter() {
  close_cycles();
  ::close(leader_);
}

void HardwareCounter::start() {
  ioctl(leader_, PERF_EVENT_IOC_RESET, PERF_IOC_FLAG_GROUP);
  ioctl(leader_, PERF_EVENT_IOC_ENABLE, PERF_IOC_FLAG_GROUP);
}

HardwareCounter::Values HardwareCounter::stop() {
  ioctl(leader_, PERF_EVENT_IOC_DISABLE, PERF_IOC_FLAG_GROUP);
  std::array<std::uint64_t, 3> values{};  // how many, leader, cycles
  if (::read(leader_, values.data(), sizeof values) <= 0) refuse("the counter was taken away while it counted");
  Values counted{values[1], {}};
  if (cycles_ >= 0) counted.cycles = values[2];
  return counted;
}

bool HardwareCounter::is_alive() {
  try {
    start();
    return stop().instructions > 0;
  } catch (const Error&) {
    return false;
  }
}

void HardwareCounter::close_cycles() {
  if (cycles_ >= 0) ::close(cycles_);
  cycles_ = -1;
}

}  // namespace clusterbench::os
