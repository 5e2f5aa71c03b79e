#pragma once
// Pages of memory, as the system hands them out. What returns false, or null, has the reason in errno.

#include <cstddef>
#include <cstdint>

namespace clusterbench::os {

std::size_t page_bytes();

// Pages that nobody may touch; `bytes` is a multiple of page_bytes().
std::byte* reserve_pages(std::size_t bytes);
bool allow_writing(std::byte* pages, std::size_t bytes);
bool allow_reading_alone(std::byte* pages, std::size_t bytes);
void release_pages(std::byte* pages, std::size_t bytes);

// From now on a forbidden access calls `describe` with its address, and then ends the process. `describe` may not
// allocate, lock or format with the standard library; it prints with print_on_error().
void watch_accesses(void (*describe)(std::uintptr_t address));
void print_on_error(const char* text, std::size_t bytes);

}  // namespace clusterbench::os
