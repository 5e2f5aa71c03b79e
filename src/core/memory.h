#pragma once
// One limit on memory: what a list, a buffer or a table may take. Counts multiply (lights x slices, cells x lights),
// and a product that no machine holds shall be refused with its numbers before memory is taken, not end the process.

#include <cstdint>

namespace clusterbench {

inline constexpr std::uint64_t k_default_memory_limit = std::uint64_t{4} << 30;  // bytes

// Of this process, as its memory is; set once before any work. `limits.memory_mib` of a configuration.
std::uint64_t memory_limit();
void set_memory_limit(std::uint64_t bytes);

// Throws Error (where: limits.memory_mib) if so many entries of so many bytes each are more than the limit. `what` they
// are, in the plural: "pairs of light lists". `remedy`: what makes them fewer.
void check_memory(const char* what, std::uint64_t entries, std::uint64_t entry_bytes,
                  const char* remedy = "use fewer lights or cells");

// Sets the limit until its end: for tests.
class MemoryLimitScope {
 public:
  explicit MemoryLimitScope(std::uint64_t bytes) : before_(memory_limit()) { set_memory_limit(bytes); }
  ~MemoryLimitScope() { set_memory_limit(before_); }
  MemoryLimitScope(const MemoryLimitScope&) = delete;
  MemoryLimitScope& operator=(const MemoryLimitScope&) = delete;

 private:
  std::uint64_t before_;
};

}  // namespace clusterbench
