#pragma once
// How fast the device runs at this moment: cycles that a shader counts, by the time of the device's clock.

#include <optional>

#include "gpu/device/device.h"

namespace clusterbench::gpu {

class ClockProbe {
 public:
  explicit ClockProbe(Device& device);

  // None where shaders cannot count, the device has no clock, or something came between. Takes some tenths of a
  // millisecond.
  std::optional<double> mhz();

 private:
  Device* device_;
  Buffers buffers_;
  std::optional<Kernel> wait_;
};

}  // namespace clusterbench::gpu
