#pragma once
// SIMD, dispatched at run time.

#include <cstddef>
#include <cstdint>

namespace clusterbench::assign {

// How many of these values are less than the one before.
std::uint32_t descents(const std::uint32_t* values, std::size_t count);

}  // namespace clusterbench::assign
