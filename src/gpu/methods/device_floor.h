#pragma once
// The least time that a device takes for a number of steps: they do nothing, and the last one writes.

#include "assign/contract/assigner.h"
#include "gpu/methods/frame_arguments.h"

namespace clusterbench::gpu {

class DeviceFloor {
 public:
  explicit DeviceFloor(Device& device);

  // Writes to the buffer of lists. As often as repeats.floor, and with its caches.
  double measured_ns(Buffers& buffers, const assign::DeviceSpans& of, const assign::DeviceRepeats& repeats);

 private:
  Device* device_;
  Kernel empty_, write_;
};

}  // namespace clusterbench::gpu
