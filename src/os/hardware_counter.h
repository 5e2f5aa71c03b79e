#pragma once
// Instructions, and cycles, by the processor's own counters: perf_event_open(2). For the calling thread, in user space.

#include <cstdint>
#include <optional>
#include <string>

namespace clusterbench::os {

// All functions throw Error, at `location`, with the part of the system that refuses.
class HardwareCounter {
 public:
  // Instructions, and cycles if the processor counts both at a time.
  explicit HardwareCounter(const char* location);
  // One event of perf_event_open(2) in place of instructions.
  HardwareCounter(const char* location, std::uint32_t type, std::uint64_t event);
  ~HardwareCounter();
  HardwareCounter(const HardwareCounter&) = delete;
  HardwareCounter& operator=(const HardwareCounter&) = delete;

  struct Values {
    std::uint64_t instructions = 0;
    std::optional<std::uint64_t> cycles;
  };
  void start();
  Values stop();

 private:
  // Whether a start and a stop count anything.
  bool is_alive();
  void close_cycles();
  [[noreturn]] void refuse(const std::string& reason) const;

  const char* location_;
  int leader_ = -1, cycles_ = -1;  // file descriptors
};

}  // namespace clusterbench::os
