#pragma once
// One limit on the memory of a list, a buffer or a table. Counts multiply (lights x slices, cells x lights); a product
// that no machine can hold must be rejected with its numbers before it is allocated, instead of ending the process.

#include <cstdint>
#include <new>
#include <string>

#include "core/error.h"

namespace clusterbench {

inline constexpr std::uint64_t k_default_memory_limit = std::uint64_t{4} << 30;  // bytes

// For this process, since memory is; set once before any work. `limits.memory_mib` of a configuration.
std::uint64_t memory_limit();
void set_memory_limit(std::uint64_t bytes);

// Throws Error (where: limits.memory_mib) if this many entries of this many bytes exceed the limit. `name`: their name,
// in the plural: "pairs of light lists". `remedy`: advice for fewer entries.
void check_memory(const char* name, std::uint64_t entries, std::uint64_t entry_bytes,
                  const char* remedy = "use fewer lights or cells");

// The result of `read`. Throws Error, which names the file, where this machine has too little memory for it.
template <class Read>
auto within_memory(const std::string& file, Read read) {
  try {
    return read();
  } catch (const std::bad_alloc&) {
    throw Error(file, "", "needs more memory than this process can get", ExitCode::internal);
  }
}

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
