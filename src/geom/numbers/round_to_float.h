#pragma once
// Double to single precision on one side of the value: bounds stay bounds.

#include <cmath>
#include <limits>

namespace clusterbench::geom {

// The largest float that is not above the value.
inline float rounded_down(double value) {
  const auto nearest = static_cast<float>(value);
  return static_cast<double>(nearest) > value ? std::nextafter(nearest, -std::numeric_limits<float>::infinity())
                                              : nearest;
}

// The smallest float that is not below the value.
inline float rounded_up(double value) {
  return -rounded_down(-value);
}

}  // namespace clusterbench::geom
