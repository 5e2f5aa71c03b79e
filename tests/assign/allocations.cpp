#include "assign/allocations.h"

#include <atomic>
#include <cstdlib>
#include <new>

// clang's thread sanitizer brings operators of its own, which do not give way to others.
#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define CLUSTERBENCH_OPERATOR_NEW_IS_TAKEN
#include <sanitizer/allocator_interface.h>
#endif
#endif

namespace {

std::atomic<std::uint64_t> allocation_count{0};

#ifdef CLUSTERBENCH_OPERATOR_NEW_IS_TAKEN
[[maybe_unused]] const int hooks = __sanitizer_install_malloc_and_free_hooks(
    [](const volatile void*, std::size_t) { ++allocation_count; }, [](const volatile void*) {});
#else
void* counted(std::size_t size) {
  ++allocation_count;
  if (void* memory = std::malloc(size != 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
#endif

}  // namespace

#ifndef CLUSTERBENCH_OPERATOR_NEW_IS_TAKEN
// Arrays come here too; nothing under test asks for more than the usual alignment. The nothrow form, which
// std::stable_sort asks, would come here, but the address sanitizer has one of its own.
void* operator new(std::size_t size) {
  return counted(size);
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocation_count;
  return std::malloc(size != 0 ? size : 1);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
#endif

namespace clusterbench::assign::testing {

std::uint64_t allocations() {
  return allocation_count;
}

}  // namespace clusterbench::assign::testing
