#include "os/processor_time.h"

#include "os/windows/windows_api.h"

namespace clusterbench::os {
namespace {

double file_time_s(const FILETIME& time) {
  constexpr double k_units_per_s = 1e7;  // of 100 ns
  return static_cast<double>(std::uint64_t{time.dwHighDateTime} << 32 | time.dwLowDateTime) / k_units_per_s;
}

}  // namespace

// The time of the kernel contains the time in which it has nothing to do.
ProcessorTime processor_time_now() {
  FILETIME idle{}, kernel{}, user{};
  if (::GetSystemTimes(&idle, &kernel, &user) == 0) return {};
  return {file_time_s(kernel) + file_time_s(user) - file_time_s(idle), 0.0};
}

double own_processor_s() {
  FILETIME begun{}, ended{}, kernel{}, user{};
  if (::GetProcessTimes(::GetCurrentProcess(), &begun, &ended, &kernel, &user) == 0) return 0.0;
  return file_time_s(kernel) + file_time_s(user);
}

std::uint64_t throttle_events() {
  return 0;
}

}  // namespace clusterbench::os
