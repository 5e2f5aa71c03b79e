#pragma once
// Memory of a process.

#include <cstdint>

namespace clusterbench::os {

// Main memory that a process takes; 0 if it is gone.
std::uint64_t resident_bytes(int process);

}  // namespace clusterbench::os
