#pragma once
// Numbers of about 106 bits: the unevaluated sum of two doubles, after Dekker 1971, "A floating-point technique for
// extending the available precision". For finding what is then proven, between double and 256 bits.
//
// Sums, products, quotients and roots are right to 15 u² of the result at worst, u = 2^-53 (Joldes, Muller and Popescu
// 2017, "Tight and rigorous error bounds for basic building blocks of double-word arithmetic"), as long as nothing
// overflows or underflows.

#include <cmath>

#include "geom/numbers/precision.h"

namespace clusterbench::geom {

struct Twofold {
  double hi = 0.0, lo = 0.0;

  Twofold() = default;
  explicit Twofold(double value) : hi(value) {}
  // |b| <= |a| / 2^52 or a sum that is exact anyway.
  static Twofold normalized(double a, double b) {
    Twofold sum(a + b);
    sum.lo = b - (sum.hi - a);
    return sum;
  }
  static Twofold exact_sum(double a, double b) {
    Twofold sum(a + b);
    const double part = sum.hi - a;
    sum.lo = (a - (sum.hi - part)) + (b - part);
    return sum;
  }
  // Veltkamp's split: two halves of 26 bits each, so that their products are exact.
  static Twofold exact_product(double a, double b) {
    constexpr double k_split = 0x1p27 + 1.0;
    const double a_big = k_split * a, b_big = k_split * b;
    const double a_hi = a_big - (a_big - a), b_hi = b_big - (b_big - b), a_lo = a - a_hi, b_lo = b - b_hi;
    Twofold product(a * b);
    product.lo = ((a_hi * b_hi - product.hi) + a_hi * b_lo + a_lo * b_hi) + a_lo * b_lo;
    return product;
  }

  Twofold operator-() const {
    Twofold negative;
    negative.hi = -hi;
    negative.lo = -lo;
    return negative;
  }
  friend Twofold operator+(const Twofold& a, const Twofold& b) {
    const Twofold high = exact_sum(a.hi, b.hi), low = exact_sum(a.lo, b.lo);
    const Twofold middle = normalized(high.hi, high.lo + low.hi);
    return normalized(middle.hi, low.lo + middle.lo);
  }
  friend Twofold operator-(const Twofold& a, const Twofold& b) { return a + (-b); }
  friend Twofold operator*(const Twofold& a, const Twofold& b) {
    const Twofold high = exact_product(a.hi, b.hi);
    return normalized(high.hi, high.lo + (a.hi * b.lo + a.lo * b.hi));
  }
  friend Twofold operator/(const Twofold& a, const Twofold& b) {
    const double first = a.hi / b.hi;
    const Twofold left = a - b * Twofold(first);
    const double second = left.hi / b.hi;
    const Twofold rest = left - b * Twofold(second);
    return normalized(first, second) + Twofold(rest.hi / b.hi);
  }
  Twofold& operator+=(const Twofold& b) { return *this = *this + b; }
  Twofold& operator/=(const Twofold& b) { return *this = *this / b; }
  friend Twofold sqrt(const Twofold& a) {
    if (!(a.hi > 0.0)) return Twofold(0.0);
    const double root = std::sqrt(a.hi);
    const Twofold left = a - exact_product(root, root);
    return normalized(root, left.hi / (2.0 * root));
  }
  friend Twofold abs(const Twofold& a) { return a.hi < 0.0 ? -a : a; }
  friend Twofold ldexp(const Twofold& a, int exponent) {
    Twofold scaled(std::ldexp(a.hi, exponent));
    scaled.lo = std::ldexp(a.lo, exponent);
    return scaled;
  }

  friend bool operator<(const Twofold& a, const Twofold& b) { return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo); }
  friend bool operator>(const Twofold& a, const Twofold& b) { return b < a; }
  friend bool operator<=(const Twofold& a, const Twofold& b) { return a.hi < b.hi || (a.hi == b.hi && a.lo <= b.lo); }
  friend bool operator>=(const Twofold& a, const Twofold& b) { return b <= a; }
  friend bool operator==(const Twofold& a, const Twofold& b) { return a.hi == b.hi && a.lo == b.lo; }
};

template <>
struct Precision<Twofold> {
  static constexpr int k_tolerance_bits = 88, k_place_bits = 100;
  static Twofold tolerance() { return Twofold(0x1p-88); }
};

}  // namespace clusterbench::geom
