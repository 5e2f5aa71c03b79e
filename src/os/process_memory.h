#pragma once
// This process and others, by their number: who runs, and who takes how much memory.

#include <cstdint>

namespace clusterbench::os {

int own_process();
bool is_running(int process);

// Main memory that a process takes; 0 if it is gone.
std::uint64_t resident_bytes(int process);

}  // namespace clusterbench::os
