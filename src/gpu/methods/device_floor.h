#pragma once
// The least time that a device takes for a number of steps: they do nothing, and the last one writes.

#include "gpu/methods/frame_arguments.h"

namespace clusterbench::gpu {

class DeviceFloor {
 public:
  explicit DeviceFloor(Device& device);

  // Writes to the buffer of lists.
  double measured_ns(Buffers& buffers, std::uint32_t steps, std::uint64_t bytes);

 private:
  Device* device_;
  Kernel empty_, write_;
};

}  // namespace clusterbench::gpu
