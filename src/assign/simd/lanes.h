#pragma once
// Numbers of lanes of vectors.

#include <cstddef>

namespace clusterbench::assign {

inline constexpr std::size_t k_most_lanes = 64;  // of any target: the padding of arrays
// Of 32 bits. Values stored per lane use the same memory on all targets, so that reports do not depend on the machine.
inline constexpr std::size_t k_row_lanes = 16;

}  // namespace clusterbench::assign
