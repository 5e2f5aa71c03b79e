#pragma once
// Floating point with 256 and 3072 bits, for finding what is then proven in exact numbers.

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "geom/rational.h"
#include "geom/search.h"

namespace clusterbench::geom {

template <unsigned bits>
using FloatOf =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<bits, boost::multiprecision::digit_base_2>,
                                  boost::multiprecision::et_off>;

using Big = FloatOf<256>;
using Huge = FloatOf<3072>;

template <>
struct Precision<Big> {
  static Big tolerance() { return ldexp(Big(1), -160); }
  static constexpr int k_place_bits = 240;
};

template <>
struct Precision<Huge> {
  static Huge tolerance() { return ldexp(Huge(1), -2600); }
  static constexpr int k_place_bits = 3000;
};

// Finite.
template <unsigned bits>
Rational exact(const FloatOf<bits>& value) {
  int exponent = 0;
  const Integer digits(ldexp(frexp(value, &exponent), static_cast<int>(bits)));
  exponent -= static_cast<int>(bits);
  return exponent >= 0 ? Rational(digits << exponent) : Rational(digits, Integer(1) << -exponent);
}

template <unsigned bits>
RationalPoint exact(const Point3<FloatOf<bits>>& p) {
  return {exact<bits>(p.x), exact<bits>(p.y), exact<bits>(p.z)};
}

}  // namespace clusterbench::geom
