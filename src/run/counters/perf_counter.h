#pragma once
// Hardware counters, through perf_event_open(2).

#include "run/counters/instruction_counter.h"

namespace clusterbench::run {

class PerfCounter final : public InstructionCounter {
 public:
  // Instructions, and cycles where the processor counts both at a time. Throws Error that says what refuses.
  PerfCounter();
  // One event of perf_event_open(2) in place of instructions.
  PerfCounter(std::uint32_t type, std::uint64_t event);
  ~PerfCounter() override;
  PerfCounter(const PerfCounter&) = delete;
  PerfCounter& operator=(const PerfCounter&) = delete;

  const char* source() const override { return "perf"; }
  bool counts_all_threads() const override { return false; }
  void start() override;
  Counted stop() override;

 private:
  // Whether a start and a stop count anything.
  bool is_alive();
  void close_cycles();

  int leader_ = -1, cycles_ = -1;  // file descriptors
};

}  // namespace clusterbench::run
