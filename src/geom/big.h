#pragma once
// Floating point with 256 bits, for finding what is then proven in exact numbers.

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "geom/rational.h"
#include "geom/search.h"

namespace clusterbench::geom {

using Big =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<256, boost::multiprecision::digit_base_2>,
                                  boost::multiprecision::et_off>;

template <>
struct Precision<Big> {
  static Big tolerance() { return ldexp(Big(1), -160); }
  static constexpr int k_place_bits = 240;
};

// Finite.
inline Rational exact(const Big& value) {
  constexpr int k_digits = 256;
  int exponent = 0;
  const Integer digits(ldexp(frexp(value, &exponent), k_digits));
  exponent -= k_digits;
  return exponent >= 0 ? Rational(digits << exponent) : Rational(digits, Integer(1) << -exponent);
}

inline RationalPoint exact(const Point3<Big>& p) {
  return {exact(p.x), exact(p.y), exact(p.z)};
}

}  // namespace clusterbench::geom
