#pragma once
// Double-precision values that are single-precision numbers.

namespace clusterbench {

// Through memory: g++ 12 omits two such roundings when it packs them into a vector (-O2, x and y of a point).
inline double rounded_to_float(double value) {
  const volatile float rounded = static_cast<float>(value);
  return static_cast<double>(rounded);
}

}  // namespace clusterbench
