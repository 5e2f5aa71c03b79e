#include "gpu/methods/device_floor.h"

namespace clusterbench::gpu {
namespace {

constexpr std::uint32_t k_writers = 256;  // in a group

}  // namespace

DeviceFloor::DeviceFloor(Device& device)
    : device_(&device), empty_(device.kernel("empty", 1)), write_(device.kernel("write", k_writers)) {}

double DeviceFloor::measured_ns(Buffers& buffers, std::uint32_t steps, std::uint64_t bytes) {
  if (steps == 0) return 0.0;
  buffers.reserve(Binding::lists, bytes, "lists");
  FrameArguments arguments;
  arguments.capacity = static_cast<std::uint32_t>(bytes / sizeof(std::uint32_t));
  Commands commands(*device_, buffers);
  commands.mark();
  for (std::uint32_t step = 1; step < steps; ++step) {
    commands.dispatch(empty_, arguments, 1);
    commands.barrier();
  }
  commands.dispatch(write_, arguments, (arguments.capacity + k_writers - 1) / k_writers);
  commands.run();
  return commands.ns_between(0, 1);
}

}  // namespace clusterbench::gpu
