#pragma once
// The wall clock of all timings.

#include <chrono>

namespace clusterbench {

// Nanoseconds since some moment; monotonic.
inline double wall_ns() {
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace clusterbench
