#pragma once
// Exact numbers: floats, doubles, and results of + - * / on them.

#include <algorithm>
#include <cmath>
#include <compare>
#include <concepts>
#include <cstdint>
#include <utility>

#include "geom/numbers/integer.h"
#include "geom/numbers/point3.h"
#include "geom/numbers/square_roots.h"

namespace clusterbench::geom {

// Most denominators are powers of two, so common powers of two are always taken out; other common factors only from
// fractions that have become long.
class Rational {
 public:
  Rational() = default;
  template <std::integral Number>
  Rational(Number value) : numerator_(value) {}
  Rational(Integer value) : numerator_(std::move(value)) {}
  // denominator: not 0.
  Rational(Integer numerator, Integer denominator)
      : numerator_(denominator.sign() < 0 ? -numerator : std::move(numerator)),
        denominator_(denominator.sign() < 0 ? -denominator : std::move(denominator)) {
    reduce();
  }
  // value: finite.
  explicit Rational(double value) {
    int exponent = 0;
    constexpr int k_digits = 53;
    numerator_ = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), k_digits));
    exponent -= k_digits;
    if (exponent >= 0)
      numerator_ = numerator_ << static_cast<unsigned>(exponent);
    else
      denominator_ = Integer(1) << static_cast<unsigned>(-exponent);
    reduce();
  }

  int sign() const { return numerator_.sign(); }
  // Equal numbers may have different ones.
  friend const Integer& numerator(const Rational& value) { return value.numerator_; }
  friend const Integer& denominator(const Rational& value) { return value.denominator_; }

  Rational operator-() const {
    Rational out = *this;
    out.numerator_ = -out.numerator_;
    return out;
  }
  friend Rational operator+(const Rational& a, const Rational& b) {
    if (a.denominator_ == b.denominator_) return {a.numerator_ + b.numerator_, a.denominator_};
    return {a.numerator_ * b.denominator_ + b.numerator_ * a.denominator_, a.denominator_ * b.denominator_};
  }
  friend Rational operator-(const Rational& a, const Rational& b) { return a + -b; }
  friend Rational operator*(const Rational& a, const Rational& b) {
    return {a.numerator_ * b.numerator_, a.denominator_ * b.denominator_};
  }
  // b: not 0.
  friend Rational operator/(const Rational& a, const Rational& b) {
    return {a.numerator_ * b.denominator_, a.denominator_ * b.numerator_};
  }
  Rational& operator+=(const Rational& b) { return *this = *this + b; }
  Rational& operator-=(const Rational& b) { return *this = *this - b; }
  Rational& operator*=(const Rational& b) { return *this = *this * b; }

  friend std::strong_ordering operator<=>(const Rational& a, const Rational& b) {
    if (a.sign() != b.sign()) return a.sign() <=> b.sign();
    if (a.denominator_ == b.denominator_) return a.numerator_ <=> b.numerator_;
    return a.numerator_ * b.denominator_ <=> b.numerator_ * a.denominator_;
  }
  friend bool operator==(const Rational& a, const Rational& b) { return std::is_eq(a <=> b); }
  friend Rational abs(const Rational& a) { return a.sign() < 0 ? -a : a; }

 private:
  void reduce() {
    if (numerator_.sign() == 0) {
      denominator_ = 1;
      return;
    }
    if (const unsigned zeros = std::min(numerator_.zeros(), denominator_.zeros()); zeros > 0) {
      numerator_ = numerator_ >> zeros;
      denominator_ = denominator_ >> zeros;
    }
    constexpr unsigned k_long = 2048;  // bits
    if (std::min(numerator_.bits(), denominator_.bits()) < k_long || denominator_.zeros() + 1 == denominator_.bits())
      return;
    const Integer common = greatest_common_divisor(numerator_, denominator_);
    numerator_ = numerator_ / common;
    denominator_ = denominator_ / common;
  }

  Integer numerator_, denominator_ = 1;
};

using RationalPoint = Point3<Rational>;

// value: finite.
inline Rational exact(double value) {
  return Rational(value);
}

inline RationalPoint exact(const Point3<double>& p) {
  return {exact(p.x), exact(p.y), exact(p.z)};
}

inline Rational norm_1(const RationalPoint& p) {
  return abs(p.x) + abs(p.y) + abs(p.z);
}

inline Rational squared_distance(const RationalPoint& a, const RationalPoint& b) {
  return dot(a - b, a - b);
}

}  // namespace clusterbench::geom
