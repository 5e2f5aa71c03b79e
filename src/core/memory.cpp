#include "core/memory.h"

#include <atomic>
#include <limits>
#include <string>

#include "core/error.h"

namespace clusterbench {
namespace {

std::atomic<std::uint64_t>& limit() {
  static std::atomic<std::uint64_t> bytes{k_default_memory_limit};
  return bytes;
}

std::string size_text(std::uint64_t bytes) {
  if (bytes < std::uint64_t{1} << 10) return std::to_string(bytes) + " bytes";
  if (bytes < std::uint64_t{1} << 20) return std::to_string(bytes >> 10) + " KiB";
  return std::to_string(bytes >> 20) + " MiB";
}

}  // namespace

std::uint64_t memory_limit() {
  return limit().load(std::memory_order_relaxed);
}

void set_memory_limit(std::uint64_t bytes) {
  limit().store(bytes, std::memory_order_relaxed);
}

void check_memory(const char* name, std::uint64_t entries, std::uint64_t entry_bytes, const char* remedy) {
  constexpr std::uint64_t k_most = std::numeric_limits<std::uint64_t>::max();
  const bool overflows = entry_bytes != 0 && entries > k_most / entry_bytes;
  const std::uint64_t bytes = overflows ? k_most : entries * entry_bytes;
  if (bytes <= memory_limit()) return;
  std::string needed = size_text(bytes);
  const std::string allowed = size_text(memory_limit());
  if (needed == allowed) needed = std::to_string(bytes) + " bytes";
  throw Error("", "limits.memory_mib",
              std::to_string(entries) + " " + name + " would take " + needed + ", and " + allowed +
                  " are allowed; raise the limit, or " + remedy);
}

}  // namespace clusterbench
