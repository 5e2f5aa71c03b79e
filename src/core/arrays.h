#pragma once
// Parallel arrays: an index has the same meaning in each of them.

#include <cstddef>

namespace clusterbench {

// Resizes each to at least this length. None becomes shorter.
template <class... Arrays>
void grow_to(std::size_t size, Arrays&... arrays) {
  ((arrays.size() < size ? arrays.resize(size) : void()), ...);
}

// The memory that they hold.
template <class... Arrays>
std::size_t bytes_of(const Arrays&... arrays) {
  return (std::size_t{0} + ... + (arrays.capacity() * sizeof(typename Arrays::value_type)));
}

}  // namespace clusterbench
