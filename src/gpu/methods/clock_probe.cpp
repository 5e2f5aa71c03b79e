#include "gpu/methods/clock_probe.h"

#include <array>

#include "gpu/methods/frame_arguments.h"

namespace clusterbench::gpu {
namespace {

// The first wait is not timed. Then a short and a long one: starting one takes its time, too, which the difference is
// free of.
constexpr std::array<std::uint32_t, 3> k_waited_cycles{1'000, 30'000, 130'000};

}  // namespace

ClockProbe::ClockProbe(Device& device) : device_(&device), buffers_(device) {
  if (!device.facts().has_shader_clock || device.facts().timestamp_bits == 0) return;
  wait_ = device.kernel("clock", 1);
  buffers_.reserve(Binding::lists, sizeof k_waited_cycles, "cycles");
}

std::optional<double> ClockProbe::mhz() {
  if (!wait_) return std::nullopt;
  Commands commands(*device_, buffers_);
  FrameArguments arguments;
  for (std::uint32_t i = 0; i < k_waited_cycles.size(); ++i) {
    arguments.capacity = k_waited_cycles[i];
    arguments.first_box = i;
    commands.dispatch(*wait_, arguments, 1);
    commands.barrier();
    commands.mark();
  }
  commands.download(Binding::lists, sizeof k_waited_cycles);
  commands.run();
  const auto cycles = commands.downloaded(0);
  const double ns = commands.ns_between(1, 2) - commands.ns_between(0, 1);
  if (!(ns > 0.0) || cycles[2] <= cycles[1]) return std::nullopt;
  return 1e3 * static_cast<double>(cycles[2] - cycles[1]) / ns;
}

}  // namespace clusterbench::gpu
