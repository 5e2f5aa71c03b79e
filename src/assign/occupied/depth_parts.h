#pragma once
// A range of depth in 32 equal parts, one bit for each. A tile has the bits of the parts with visible surfaces, a light
// those of the parts that it reaches.

#include <algorithm>
#include <cstdint>
#include <limits>

namespace clusterbench::assign {

// `last_part`: the part for depths at the end of the range and behind it.
template <int last_part>
class DepthPartsTo {
 public:
  static constexpr int k_parts = 32;

  // lo <= hi. If lo == hi, every depth is in the first part.
  DepthPartsTo(float lo, float hi)
      : lo_(lo), scale_(hi > lo ? std::min(k_parts / (hi - lo), std::numeric_limits<float>::max()) : 0.0f) {}

  // Monotonic in the depth, however it is rounded, so a light's bits are those of all depths that it reaches. Depths
  // before the range are in the first part.
  int part_of(float depth) const {
    const float part = (depth - lo_) * scale_;
    return part >= last_part ? last_part : part > 0.0f ? static_cast<int>(part) : 0;
  }
  std::uint32_t bit_of(float depth) const { return 1u << part_of(depth) % k_parts; }
  // The bits of the parts from `near` to `far`, near <= far: a full mask, shifted from both ends; by counts modulo 32,
  // as GPUs do.
  std::uint32_t bits_between(float near, float far) const {
    const int first = part_of(near), last = part_of(far);
    return ~0u >> (static_cast<unsigned>(k_parts - 1 - (last - first)) % k_parts) << first % k_parts;
  }

 private:
  float lo_, scale_;
};

using DepthParts = DepthPartsTo<31>;
// With a mistake that Wicked Engine has shipped: the end of the range is a part 32, whose bit becomes bit 0 by the
// shift. So a light that reaches only the farthest pixel has bit 31, but the pixel has bit 0.
using DepthPartsTo32 = DepthPartsTo<32>;

}  // namespace clusterbench::assign
