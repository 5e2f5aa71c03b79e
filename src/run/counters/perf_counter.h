#pragma once
// The processor's own counters.

#include "os/hardware_counter.h"
#include "run/counters/instruction_counter.h"

namespace clusterbench::run {

class PerfCounter final : public InstructionCounter {
 public:
  PerfCounter() : counter_(k_option) {}
  // Counts one event of perf_event_open(2) in place of instructions.
  PerfCounter(std::uint32_t type, std::uint64_t event) : counter_(k_option, type, event) {}

  const char* source() const override { return "perf"; }
  bool counts_all_threads() const override { return false; }
  void start() override { counter_.start(); }
  Counted stop() override {
    const os::HardwareCounter::Values values = counter_.stop();
    return {values.instructions, values.cycles};
  }

 private:
  static constexpr const char* k_option = "--count=perf";

  os::HardwareCounter counter_;
};

}  // namespace clusterbench::run
