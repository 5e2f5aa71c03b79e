#pragma once
// Double-precision values that are single-precision numbers.

namespace clusterbench {

// Through memory: where g++ 12 packs two such roundings into a vector, it leaves them out (-O2, x and y of a point).
inline double rounded_to_float(double value) {
  const volatile float rounded = static_cast<float>(value);
  return static_cast<double>(rounded);
}

}  // namespace clusterbench
