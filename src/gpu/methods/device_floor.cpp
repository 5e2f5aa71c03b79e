#include "gpu/methods/device_floor.h"

#include "gpu/methods/repeated_work.h"

namespace clusterbench::gpu {
namespace {

constexpr std::uint32_t k_writers = 256;  // in a group

}  // namespace

DeviceFloor::DeviceFloor(Device& device)
    : device_(&device), empty_(device.kernel("empty", 1)), write_(device.kernel("write", k_writers)) {}

double DeviceFloor::measured_ns(Buffers& buffers, const assign::DeviceSpans& of, const assign::DeviceRepeats& repeats) {
  if (of.dispatches == 0) return 0.0;
  buffers.reserve(Binding::lists, of.result_bytes, "lists");
  FrameArguments arguments;
  arguments.capacity = static_cast<std::uint32_t>(of.result_bytes / sizeof(std::uint32_t));
  Commands commands(*device_, buffers);
  RepeatedWork work(commands, {.caches = repeats.caches, .run = repeats.floor});
  work.record([] {},
              [&] {
                for (std::uint32_t step = 1; step < of.dispatches; ++step) {
                  commands.dispatch(empty_, arguments, 1);
                  commands.barrier();
                }
                commands.dispatch(write_, arguments, (arguments.capacity + k_writers - 1) / k_writers);
              });
  commands.run();
  return work.spans().run_ns;
}

}  // namespace clusterbench::gpu
