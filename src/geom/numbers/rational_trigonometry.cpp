#include "geom/numbers/rational_trigonometry.h"

#include <algorithm>

namespace clusterbench::geom {
namespace {

// value / 2^bits
Rational scaled_down(const Integer& value, unsigned bits) {
  return Rational(value) / Rational(Integer(1) << bits);
}

// A cosine above 1 would make the cone contain no point at all, not even one of the axis.
RationalInterval cut_to_1(const RationalInterval& bounds) {
  return {std::max(bounds.lo, Rational(-1)), std::min(bounds.hi, Rational(1))};
}

// The first terms of the series, in rational numbers: any fixed point would be too coarse for some angle. The next
// terms are below 2^-bits for an angle below 2^(-bits / 6).
AngleBounds bounds_of_small(const Rational& x) {
  const Rational square = x * x, fourth = square * square;
  const Rational cosine = 1 - square / 2 + fourth / 24, sine = x * (1 - square / 6 + fourth / 120);
  return {{cosine - fourth * square / 720, cosine}, {sine - x * fourth * square / 5040, sine}};
}

}  // namespace

// In fixed point with unit u = 2^-bits. Term n of the exponential series is term n-1 times x/n. Terms are at most 2, as
// x < 2, so its error is at most the inherited one times 2/n, 2/n u from the rounding of x, and u + u/n from rounding
// product and quotient: 3 u, 5.5 u, 5.7 u, 4.6 u and less after that. When a computed term has become 0, the exact one
// is below 8 u, and those after it sum up to less than that. There are fewer than 500 terms at 3100 bits, half of them
// in each of the two sums: 250 * 8 u + 16 u < 2^11 u.
AngleBounds bounds_of_angle(const Rational& angle, unsigned bits) {
  if (angle.sign() == 0) return {{1, 1}, {0, 0}};
  if (angle * Rational(Integer(1) << (bits / 6)) < 1) return bounds_of_small(angle);
  const Integer x = (numerator(angle) << bits) / denominator(angle);
  Integer term = Integer(1) << bits, sums[2] = {term, 0};  // cosine, sine
  for (int n = 1; term != 0; ++n) {
    term = ((term * x) >> bits) / n;
    if (n % 4 < 2)
      sums[n % 2] += term;
    else
      sums[n % 2] -= term;
  }
  constexpr int k_error = 1 << 11;
  const auto around = [&](const Integer& value) -> RationalInterval {
    return {scaled_down(value - k_error, bits), scaled_down(value + k_error, bits)};
  };
  return {cut_to_1(around(sums[0])), cut_to_1(around(sums[1]))};
}

// sqrt(n / d) = sqrt(n d 4^k) / (d 2^k): the integer root is within 1 of it, and k makes this error small.
Rational root_above(const Rational& value) {
  if (value.sign() == 0) return 0;
  constexpr unsigned k_bits = 310;
  const Integer d = denominator(value);
  const Integer root = sqrt((numerator(value) * d) << (2 * k_bits)) + 1;
  return scaled_down(root, k_bits) / Rational(d);
}

}  // namespace clusterbench::geom
