#pragma once
// Arrays that stand side by side: an index means the same in each of them.

#include <cstddef>

namespace clusterbench {

// Makes each at least so long. None becomes shorter.
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
