#pragma once
// Floating point with 256, 1024 and 3072 bits, for the search of evidence that is then proven in exact numbers.

#include <cmath>

#include "geom/numbers/binary_float.h"
#include "geom/numbers/point3.h"
#include "geom/numbers/precision.h"
#include "geom/numbers/rational.h"

namespace clusterbench::geom {

using Float256 = BinaryFloat<256>;
using Float1024 = BinaryFloat<1024>;
using Float3072 = BinaryFloat<3072>;

template <>
struct Precision<Float256> {
  static constexpr int k_tolerance_bits = 160, k_root_bits = 240;
  static Float256 tolerance() { return ldexp(Float256(1), -k_tolerance_bits); }
};

template <>
struct Precision<Float1024> {
  static constexpr int k_tolerance_bits = 860, k_root_bits = 980;
  static Float1024 tolerance() { return ldexp(Float1024(1), -k_tolerance_bits); }
};

template <>
struct Precision<Float3072> {
  static constexpr int k_tolerance_bits = 2600, k_root_bits = 3000;
  static Float3072 tolerance() { return ldexp(Float3072(1), -k_tolerance_bits); }
};

// Root of a finite number, right to two units in the last place; 0 for a negative number. Newton's steps for 1 / sqrt,
// starting from a double's; each step doubles the bits.
template <unsigned bits>
struct SquareRoot<BinaryFloat<bits>> {
  static BinaryFloat<bits> of(const BinaryFloat<bits>& square) {
    if (!(square > 0)) return 0;
    int exponent = 0;
    BinaryFloat<bits> part = frexp(square, &exponent);  // 0.5 <= part < 1
    if (exponent % 2 != 0) {
      part = ldexp(part, 1);
      --exponent;
    }
    BinaryFloat<bits> inverse(1.0 / std::sqrt(static_cast<double>(part)));
    for (unsigned right = 48; right < bits / 2 + 8; right *= 2)
      inverse += ldexp(BinaryFloat<bits>(inverse * (1 - part * inverse * inverse)), -1);
    BinaryFloat<bits> root = part * inverse;
    root += ldexp(BinaryFloat<bits>(inverse * (part - root * root)), -1);
    return ldexp(root, exponent / 2);
  }
};

// value: finite.
template <unsigned bits>
Rational exact(const BinaryFloat<bits>& value) {
  int exponent = 0;
  const Integer digits(ldexp(frexp(value, &exponent), static_cast<int>(bits)));
  exponent -= static_cast<int>(bits);
  return exponent >= 0 ? Rational(digits << exponent) : Rational(digits, Integer(1) << -exponent);
}

template <unsigned bits>
RationalPoint exact(const Point3<BinaryFloat<bits>>& p) {
  return {exact<bits>(p.x), exact<bits>(p.y), exact<bits>(p.z)};
}

}  // namespace clusterbench::geom
