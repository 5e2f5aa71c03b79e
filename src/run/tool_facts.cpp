// What a result says about the tool and the machine that made it.

#include <sys/utsname.h>
#include <unistd.h>

#include <ctime>
#include <fstream>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <thread>

#include "assign/lists/list_builder.h"
#include "run/counters/processor.h"
#include "run/git_sha.h"
#include "run/result.h"

namespace clusterbench::run {
namespace {

std::string compiler() {
#if defined(__clang__)
  return std::string("clang ") + __clang_version__;
#elif defined(__GNUC__)
  return std::string("g++ ") + __VERSION__;
#else
  return "unknown";
#endif
}

std::string dotted(int major, int minor, int patch) {
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
}

}  // namespace

ToolFacts tool_facts() {
  return {.version = CLUSTERBENCH_VERSION,
          .git_sha = CLUSTERBENCH_GIT_SHA,
          .compiler = compiler(),
          .flags = CLUSTERBENCH_FLAGS,
          .build_type = CLUSTERBENCH_BUILD_TYPE,
          .simd_target = assign::simd_target_name(),
          .libraries = {CLUSTERBENCH_LIBRARIES{"glm", dotted(GLM_VERSION_MAJOR, GLM_VERSION_MINOR, GLM_VERSION_PATCH)},
                        {"nlohmann_json", dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                                                 NLOHMANN_JSON_VERSION_PATCH)}}};
}

MachineFacts machine_facts() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  const Processor processor = processor_of(cpuinfo);
  MachineFacts facts;
  facts.cpu = processor.name;
  facts.family = processor.family;
  facts.model = processor.model;
  facts.stepping = processor.stepping;
  facts.caches = caches_of("/sys/devices/system/cpu/cpu0/cache");
  facts.cores = static_cast<int>(std::thread::hardware_concurrency());
  facts.ram_bytes =
      static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGE_SIZE));
  utsname names{};
  if (uname(&names) == 0) facts.os = std::string(names.sysname) + " " + names.release + " " + names.machine;
  return facts;
}

std::optional<ClockFacts> clock_now() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  return clock_of(cpuinfo, "/sys/devices/system/cpu/cpu0/cpufreq");
}

std::optional<double> load_now() {
  std::ifstream loadavg("/proc/loadavg");
  return load_of(loadavg);
}

std::string date_now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[sizeof "2000-01-01T00:00:00Z"];
  return {text, std::strftime(text, sizeof text, "%FT%TZ", &utc)};
}

}  // namespace clusterbench::run
