#pragma once
// The wall clock by which everything here is timed.

#include <chrono>

namespace clusterbench {

// Nanoseconds since some moment; never goes back.
inline double wall_ns() {
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace clusterbench
