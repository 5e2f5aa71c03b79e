#pragma once
// A range of depth in 32 equal parts, a bit for each: of a tile those in which visible surfaces lie, of a light those
// that it reaches.

#include <algorithm>
#include <cstdint>
#include <limits>

namespace clusterbench::assign {

// `last_part`: where depths at the end of the range, and behind it, are put.
template <int last_part>
class DepthPartsTo {
 public:
  static constexpr int k_parts = 32;

  // lo <= hi. Of one depth alone all is the first part.
  DepthPartsTo(float lo, float hi)
      : lo_(lo), scale_(hi > lo ? std::min(k_parts / (hi - lo), std::numeric_limits<float>::max()) : 0.0f) {}

  // Ascends with the depth, however it is rounded, so that a light's bits are those of all depths that it reaches.
  // Depths before the range are in the first part.
  int part_of(float depth) const {
    const float part = (depth - lo_) * scale_;
    return part >= last_part ? last_part : part > 0.0f ? static_cast<int>(part) : 0;
  }
  std::uint32_t bit_of(float depth) const { return 1u << part_of(depth) % k_parts; }
  // Of the parts from `near` to `far`, near <= far: a full mask, shifted from both ends; by counts modulo 32, as GPUs
  // do.
  std::uint32_t bits_between(float near, float far) const {
    const int first = part_of(near), last = part_of(far);
    return ~0u >> (static_cast<unsigned>(k_parts - 1 - (last - first)) % k_parts) << first % k_parts;
  }

 private:
  float lo_, scale_;
};

using DepthParts = DepthPartsTo<31>;
// With a mistake that Wicked Engine has shipped: the end of the range is a part 32, of which the shift makes bit 0. So
// a light that reaches nothing but the farthest pixel has bit 31, and the pixel has not.
using DepthPartsTo32 = DepthPartsTo<32>;

}  // namespace clusterbench::assign
