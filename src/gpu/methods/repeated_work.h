#pragma once
// A frame's work on the device, as often and with such caches as its times ask for (assign::DeviceRepeats).

#include <functional>
#include <vector>

#include "assign/contract/assigner.h"
#include "gpu/device/device.h"

namespace clusterbench::gpu {

class RepeatedWork {
 public:
  using Steps = std::function<void()>;

  RepeatedWork(Commands& commands, const assign::DeviceRepeats& repeats) : commands_(commands), repeats_(repeats) {}

  // Records both, with marks around them. Where they are repeated, `upload` must end with a barrier; `run` gets one.
  // Call once. Before cold work: Device::reserve_flushed(). Then commands.download(), and commands.run().
  void record(const Steps& upload, const Steps& run);
  // After commands.run(), of one repetition: without result_bytes.
  assign::DeviceSpans spans() const;

 private:
  struct Span {
    std::uint32_t first, last;
  };

  void record_cold(const Steps& upload, const Steps& run, std::uint32_t repeats);
  void record_warm(const Steps& upload, const Steps& run);
  void run_once(const Steps& run);
  // The mean of what these spans have of `repeats` each.
  double mean_ns(const std::vector<Span>& spans, std::uint32_t repeats) const;

  Commands& commands_;
  assign::DeviceRepeats repeats_;
  std::vector<Span> uploads_, runs_;
  std::uint32_t steps_ = 0;
};

}  // namespace clusterbench::gpu
