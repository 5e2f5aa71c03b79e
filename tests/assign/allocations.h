#pragma once
// Counts what the test program takes from the heap, to show that a steady frame takes nothing.

#include <cstdint>

namespace clusterbench::assign::testing {

// Calls of operator new (under clang's thread sanitizer: of malloc) since the program began.
std::uint64_t allocations();

}  // namespace clusterbench::assign::testing
