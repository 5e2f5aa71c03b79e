#pragma once
// Which processor this is, so that two machines whose processors share a marketing name are told apart.

#include <cstdint>
#include <filesystem>
#include <istream>
#include <string>
#include <utility>
#include <vector>

namespace clusterbench::run {

struct Processor {
  std::string name;  // "AMD EPYC", "Arm Neoverse-N1"; "unknown"
  // As the vendor numbers them; on ARM implementer, part, and variant with revision ("r3p1"). "" where Linux has none.
  std::string family, model, stepping;
};

// The first processor of a /proc/cpuinfo.
Processor processor_of(std::istream& cpuinfo);

// ("l1d", bytes), ("l1i", bytes), ("l2", bytes), ("l3", bytes), as far as known: of one core, of a folder like
// /sys/devices/system/cpu/cpu0/cache.
std::vector<std::pair<std::string, std::uint64_t>> caches_of(const std::filesystem::path& folder);

}  // namespace clusterbench::run
