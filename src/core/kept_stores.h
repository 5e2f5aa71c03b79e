#pragma once
// For code that is timed: the compiler may not leave out stores that nothing reads.

#include <atomic>

namespace clusterbench {

namespace internal {

// Where the standard's way puts the address: whoever reads a volatile object may read what it leads to.
inline const void* volatile g_kept = nullptr;

inline void keep_stores_by_standard(const void* memory) {
  g_kept = memory;
  std::atomic_signal_fence(std::memory_order_seq_cst);
}

}  // namespace internal

// All that was written behind `memory` is in memory from here on, as the compiler sees it. Costs no instruction with
// compilers that know GNU's assembly, and one store with others (Microsoft's).
inline void keep_stores(const void* memory) {
#ifdef __GNUC__
  asm volatile("" : : "r"(memory) : "memory");
#else
  internal::keep_stores_by_standard(memory);
#endif
}

}  // namespace clusterbench
