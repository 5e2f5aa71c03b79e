#include "os/processor_time.h"

#include <mach/mach.h>
#include <sys/resource.h>
#include <unistd.h>

namespace clusterbench::os {
namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

ProcessorTime processor_time_now() {
  host_cpu_load_info_data_t ticks{};
  mach_msg_type_number_t count = HOST_CPU_LOAD_INFO_COUNT;
  const mach_port_t host = mach_host_self();
  const kern_return_t failed = host_statistics(host, HOST_CPU_LOAD_INFO, reinterpret_cast<host_info_t>(&ticks), &count);
  mach_port_deallocate(mach_task_self(), host);
  if (failed != KERN_SUCCESS) return {};
  const auto busy = static_cast<double>(ticks.cpu_ticks[CPU_STATE_USER]) + ticks.cpu_ticks[CPU_STATE_SYSTEM] +
                    ticks.cpu_ticks[CPU_STATE_NICE];
  return {busy / static_cast<double>(::sysconf(_SC_CLK_TCK)), 0.0};
}

double own_processor_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::uint64_t throttle_events() {
  return 0;
}

}  // namespace clusterbench::os
