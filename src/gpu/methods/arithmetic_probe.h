#pragma once
// What a device makes of single-precision arithmetic, held bit by bit against the processor. The lists of methods on
// the device are conservative only where sums and products are what their derivations take them for.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gpu/device/device.h"

namespace clusterbench::gpu {

enum class Rounding : std::uint8_t { to_nearest, either_way, wrong };

// What was found.
struct Arithmetic {
  Rounding rounding = Rounding::to_nearest;  // of sums and products; either_way: to the next number on either side
  bool contracts = false;                    // a product and a sum were rounded once
  bool reorders = false;                     // a sum of three was not made from the left
  bool flushes_denormals = false;
  // The largest error of a / b, sqrt(a) and log2(a); the latter in ulp beyond [0.5, 2], absolute within.
  double division_ulp = 0.0, sqrt_ulp = 0.0, log2_ulp = 0.0, log2_error = 0.0;
};

// What a shader of the probe does in place of what it must (probe_sums.comp), for tests of the probe.
enum class ProbeMode : std::uint32_t { as_it_is, contracted, reordered, rounded_off };

Arithmetic probed_arithmetic(Device& device, ProbeMode mode = ProbeMode::as_it_is);
// Of device(), probed once for each device of the process.
Arithmetic arithmetic_of_device();

// The reason why methods on such a device can lose lights, as a sentence; "" if they cannot. What only lookups of
// readings rest on (division, root, logarithm) and denormals are no reason.
std::string contradiction(const Arithmetic& found, const DeviceFacts& facts);

}  // namespace clusterbench::gpu
