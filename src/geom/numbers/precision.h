#pragma once
// The properties of a number type that the algorithms need: its square root, and its resolution.

#include <cmath>

namespace clusterbench::geom {

// How a number type takes square roots.
template <class Real>
struct SquareRoot {
  static Real of(const Real& square) {
    using std::sqrt;
    return sqrt(square);
  }
};

// The resolution of a number type, relative to the size of the numbers involved.
template <class Real>
struct Precision;
template <>
struct Precision<double> {
  static constexpr int k_tolerance_bits = 38, k_root_bits = 53;
  static double tolerance() { return 0x1p-38; }
};

}  // namespace clusterbench::geom
