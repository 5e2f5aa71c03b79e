#pragma once
// A range of depth in 32 equal parts, a bit for each: of a tile those in which visible surfaces lie, of a light those
// that it reaches.

#include <algorithm>
#include <cstdint>
#include <limits>

namespace clusterbench::assign {

class DepthParts {
 public:
  static constexpr int k_parts = 32;

  // lo <= hi. Of one depth alone all is the first part.
  DepthParts(float lo, float hi)
      : lo_(lo), scale_(hi > lo ? std::min(k_parts / (hi - lo), std::numeric_limits<float>::max()) : 0.0f) {}

  // Ascends with the depth, however it is rounded, so that a light's bits are those of all depths that it reaches.
  // Depths beside the range are in the part at its end.
  int part_of(float depth) const {
    const float part = (depth - lo_) * scale_;
    return part >= k_parts - 1 ? k_parts - 1 : part > 0.0f ? static_cast<int>(part) : 0;
  }
  std::uint32_t bit_of(float depth) const { return 1u << part_of(depth); }
  // Of the parts from `near` to `far`, near <= far: a full mask, shifted from both ends.
  std::uint32_t bits_between(float near, float far) const {
    return ~0u << part_of(near) & ~0u >> (k_parts - 1 - part_of(far));
  }

 private:
  float lo_, scale_;
};

}  // namespace clusterbench::assign
