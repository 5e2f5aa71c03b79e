#pragma once
// Numbers of about 106 bits: the unevaluated sum of two doubles, after Dekker 1971, "A floating-point technique for
// extending the available precision". For the search of evidence that is proven later; between double and 256 bits.
//
// All users assume that a sum, product, quotient or root is right to 64 u² of itself, u = 2^-53, as long as nothing
// overflows or underflows. That is several times the error proven for sums and products (Joldes, Muller and Popescu
// 2017, "Tight and rigorous error bounds for basic building blocks of double-word arithmetic"), and more than the error
// that remains after the one correction step of a quotient or root.

#include <cmath>

#include "geom/numbers/precision.h"

namespace clusterbench::geom {

struct DoubleDouble {
  double hi = 0.0, lo = 0.0;

  DoubleDouble() = default;
  explicit DoubleDouble(double value) : hi(value) {}
  // |b| <= |a| / 2^52 or a sum that is exact anyway.
  static DoubleDouble normalized(double a, double b) {
    DoubleDouble sum(a + b);
    sum.lo = b - (sum.hi - a);
    return sum;
  }
  static DoubleDouble exact_sum(double a, double b) {
    DoubleDouble sum(a + b);
    const double part = sum.hi - a;
    sum.lo = (a - (sum.hi - part)) + (b - part);
    return sum;
  }
  // Veltkamp's split: two halves of 26 bits each, so that their products are exact.
  static DoubleDouble exact_product(double a, double b) {
    constexpr double k_split = 0x1p27 + 1.0;
    const double a_big = k_split * a, b_big = k_split * b;
    const double a_hi = a_big - (a_big - a), b_hi = b_big - (b_big - b), a_lo = a - a_hi, b_lo = b - b_hi;
    DoubleDouble product(a * b);
    product.lo = ((a_hi * b_hi - product.hi) + a_hi * b_lo + a_lo * b_hi) + a_lo * b_lo;
    return product;
  }

  DoubleDouble operator-() const {
    DoubleDouble negative;
    negative.hi = -hi;
    negative.lo = -lo;
    return negative;
  }
  friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble high = exact_sum(a.hi, b.hi), low = exact_sum(a.lo, b.lo);
    const DoubleDouble middle = normalized(high.hi, high.lo + low.hi);
    return normalized(middle.hi, low.lo + middle.lo);
  }
  friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + (-b); }
  friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble high = exact_product(a.hi, b.hi);
    return normalized(high.hi, high.lo + (a.hi * b.lo + a.lo * b.hi));
  }
  friend DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
    const double first = a.hi / b.hi;
    const DoubleDouble left = a - b * DoubleDouble(first);
    const double second = left.hi / b.hi;
    const DoubleDouble rest = left - b * DoubleDouble(second);
    return normalized(first, second) + DoubleDouble(rest.hi / b.hi);
  }
  DoubleDouble& operator+=(const DoubleDouble& b) { return *this = *this + b; }
  DoubleDouble& operator/=(const DoubleDouble& b) { return *this = *this / b; }
  friend DoubleDouble sqrt(const DoubleDouble& a) {
    if (!(a.hi > 0.0)) return DoubleDouble(0.0);
    const double root = std::sqrt(a.hi);
    const DoubleDouble left = a - exact_product(root, root);
    return normalized(root, left.hi / (2.0 * root));
  }
  friend DoubleDouble abs(const DoubleDouble& a) { return a.hi < 0.0 ? -a : a; }
  friend DoubleDouble ldexp(const DoubleDouble& a, int exponent) {
    DoubleDouble scaled(std::ldexp(a.hi, exponent));
    scaled.lo = std::ldexp(a.lo, exponent);
    return scaled;
  }

  friend bool operator<(const DoubleDouble& a, const DoubleDouble& b) {
    return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo);
  }
  friend bool operator>(const DoubleDouble& a, const DoubleDouble& b) { return b < a; }
  friend bool operator<=(const DoubleDouble& a, const DoubleDouble& b) {
    return a.hi < b.hi || (a.hi == b.hi && a.lo <= b.lo);
  }
  friend bool operator>=(const DoubleDouble& a, const DoubleDouble& b) { return b <= a; }
  friend bool operator==(const DoubleDouble& a, const DoubleDouble& b) { return a.hi == b.hi && a.lo == b.lo; }
};

template <>
struct Precision<DoubleDouble> {
  static constexpr int k_tolerance_bits = 88, k_root_bits = 100;
  static DoubleDouble tolerance() { return DoubleDouble(0x1p-88); }
};

}  // namespace clusterbench::geom
