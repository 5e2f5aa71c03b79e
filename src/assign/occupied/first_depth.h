#pragma once
// The first single-precision depth for which a predicate is true, if it is then true for all depths behind it.

#include <bit>
#include <cstdint>
#include <limits>

namespace clusterbench::assign {

// Floats as integers of the same order, and the inverse.
inline std::int64_t order_of(float value) {
  const auto bits = std::bit_cast<std::int32_t>(value);
  return bits >= 0 ? bits : std::int64_t{std::numeric_limits<std::int32_t>::min()} - bits;
}
inline float in_order(std::int64_t order) {
  const std::int64_t bits = order >= 0 ? order : std::int64_t{std::numeric_limits<std::int32_t>::min()} - order;
  return std::bit_cast<float>(static_cast<std::int32_t>(bits));
}

// The predicate is false for `before`, and assumed to be true for `behind`.
template <class Holds>
float first_between(float before, float behind, Holds&& holds) {
  std::int64_t no = order_of(before), yes = order_of(behind);
  while (yes - no > 1) {
    const std::int64_t middle = no + (yes - no) / 2;
    (holds(in_order(middle)) ? yes : no) = middle;
  }
  return in_order(yes);
}

}  // namespace clusterbench::assign
