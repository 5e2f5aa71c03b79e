#pragma once
// A std::vector that begins at a cache line, so that SIMD vectors at multiples of their size do not cross one. oneTBB's
// allocator is not used: it allocates without operator new, by which tests count the allocations of a steady frame.

#include <cstddef>
#include <new>
#include <vector>

namespace clusterbench {

inline constexpr std::size_t k_cache_line = 64;  // bytes

template <class T>
struct CacheLineAllocator {
  using value_type = T;

  CacheLineAllocator() = default;
  template <class Other>
  CacheLineAllocator(const CacheLineAllocator<Other>&) {}  // NOLINT(google-explicit-constructor): allocators convert

  T* allocate(std::size_t count) {
    if (count > static_cast<std::size_t>(-1) / sizeof(T)) throw std::bad_array_new_length();
    return static_cast<T*>(::operator new (count * sizeof(T), std::align_val_t{k_cache_line}));
  }
  void deallocate(T* at, std::size_t) { ::operator delete (at, std::align_val_t{k_cache_line}); }
  friend bool operator==(const CacheLineAllocator&, const CacheLineAllocator&) { return true; }
};

template <class T>
using AlignedVector = std::vector<T, CacheLineAllocator<T>>;

}  // namespace clusterbench
