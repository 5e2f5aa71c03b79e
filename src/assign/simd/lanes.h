#pragma once
// How many lanes vectors have.

#include <cstddef>

namespace clusterbench::assign {

inline constexpr std::size_t k_most_lanes = 64;  // of any target: what arrays are padded by
// Of 32 bits. What is kept lane by lane takes as much memory on all targets, so that what is reported does not depend
// on the machine.
inline constexpr std::size_t k_row_lanes = 16;

}  // namespace clusterbench::assign
