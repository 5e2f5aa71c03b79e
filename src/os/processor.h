#pragma once
// Identifies the processor, so that machines whose processors share a marketing name can be distinguished.

#include <cstdint>
#include <filesystem>
#include <istream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace clusterbench::os {

struct Processor {
  std::string name;  // "AMD EPYC", "Arm Neoverse-N1"; "unknown"
  // The vendor's numbers; on ARM implementer, part, and variant with revision ("r3p1"). "" if Linux has none.
  std::string family, model, stepping;
};

// The first processor of a /proc/cpuinfo.
Processor processor_of(std::istream& cpuinfo);

// ("l1d", bytes), ("l1i", bytes), ("l2", bytes), ("l3", bytes), as far as known: for one core, from a folder like
// /sys/devices/system/cpu/cpu0/cache.
std::vector<std::pair<std::string, std::uint64_t>> caches_of(const std::filesystem::path& folder);

// The clock when something was timed.
struct Clock {
  double now_mhz = 0.0;            // mean of all cores
  std::optional<double> most_mhz;  // that the system allows the first core
};

// From a /proc/cpuinfo, and a folder like /sys/devices/system/cpu/cpu0/cpufreq. nullopt if the first has no clock.
std::optional<Clock> clock_of(std::istream& cpuinfo, const std::filesystem::path& folder);

// The mean of the last minute in a /proc/loadavg.
std::optional<double> load_of(std::istream& loadavg);

}  // namespace clusterbench::os
