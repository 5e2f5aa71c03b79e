#include "run/timing/cache_sweep.h"

#include <algorithm>
#include <new>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/kept_stores.h"
#include "os/machine.h"

namespace clusterbench::run {

std::uint64_t sweep_bytes(std::optional<int> wanted_mib) {
  if (wanted_mib) return static_cast<std::uint64_t>(*wanted_mib) << 20;
  constexpr std::uint64_t k_unknown = 64 << 20, k_most = 256 << 20;
  std::uint64_t all = 0;
  for (const auto& [name, bytes] : os::caches_now()) all += bytes;
  return all == 0 ? k_unknown : std::min(all + all / 4, k_most);
}

void sweep_caches(std::uint64_t bytes) {
  constexpr std::size_t k_line = 64;  // one plain store to each line: memset() may use stores that bypass the caches
  static std::vector<unsigned char> buffer;
  static unsigned char value = 0;
  try {
    if (buffer.size() < bytes) buffer = std::vector<unsigned char>(bytes);
  } catch (const std::bad_alloc&) {
    throw Error("", "timing.sweep_mib",
                std::to_string(bytes >> 20) + " MiB to empty the caches with are not to be had here; allowed: less");
  }
  ++value;
  for (std::size_t at = 0; at < bytes; at += k_line) buffer[at] = value;
  keep_stores(buffer.data());
}

int cold_rounds(int rounds, std::size_t frames, std::uint64_t bytes) {
  constexpr double k_bytes_per_s = 2e10, k_most_s = 0.1;
  const double per_round_s = static_cast<double>(frames) * static_cast<double>(bytes) / k_bytes_per_s;
  return std::clamp(static_cast<int>(std::min(k_most_s / per_round_s, 1e6)), 1, std::max(rounds, 1));
}

}  // namespace clusterbench::run
