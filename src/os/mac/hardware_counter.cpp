#include "os/hardware_counter.h"

#include "core/error.h"

namespace clusterbench::os {

// All other functions need an object, and there is none.
void HardwareCounter::refuse(const std::string& reason) const {
  throw Error("", location_, reason);
}

HardwareCounter::HardwareCounter(const char* location) : location_(location) {
  refuse("macOS lets no program of users read the processor's counters; on Linux perf and valgrind count");
}

HardwareCounter::HardwareCounter(const char* location, std::uint32_t, std::uint64_t) : HardwareCounter(location) {}

HardwareCounter::~HardwareCounter() = default;

void HardwareCounter::start() {}

HardwareCounter::Values HardwareCounter::stop() {
  return {};
}

bool HardwareCounter::is_alive() {
  return false;
}

void HardwareCounter::close_cycles() {
  leader_ = cycles_ = -1;
}

}  // namespace clusterbench::os
