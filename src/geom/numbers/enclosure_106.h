#pragma once
// Real numbers between proven bounds, middle ± radius, as in geom/numbers/wide_enclosure.h (1024 bits), here with 106
// bits. Enough for all pairs except those that touch to within about 2^-85, at a hundredth of the time.

#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/numbers/double_double.h"
#include "geom/numbers/enclosed_roots.h"

namespace clusterbench::geom {

class Enclosure106 {
 public:
  using Middle = DoubleDouble;

  Enclosure106() = default;
  explicit Enclosure106(double value) : middle_(value) {}
  explicit Enclosure106(const DoubleDouble& value) : middle_(value) {}
  Enclosure106(const DoubleDouble& middle, double radius) : middle_(middle), radius_(radius) {}

  static Enclosure106 of(const DoubleDouble& lo, const DoubleDouble& hi) {
    const DoubleDouble half = DoubleDouble(0.5) * (hi - lo);
    return made(DoubleDouble(0.5) * (lo + hi), std::abs(half.hi));
  }

  const DoubleDouble& middle() const { return middle_; }
  double radius() const { return radius_; }

  Enclosure106 operator-() const { return {-middle_, radius_}; }
  friend Enclosure106 operator+(const Enclosure106& a, const Enclosure106& b) {
    return made(a.middle_ + b.middle_, a.radius_ + b.radius_);
  }
  friend Enclosure106 operator-(const Enclosure106& a, const Enclosure106& b) { return a + (-b); }
  friend Enclosure106 operator*(const Enclosure106& a, const Enclosure106& b) {
    return made(a.middle_ * b.middle_, size(a) * b.radius_ + size(b) * a.radius_ + a.radius_ * b.radius_);
  }
  // |a/b - a'/b'| <= (radius of a + |a'/b'| * radius of b) / |b|
  friend Enclosure106 operator/(const Enclosure106& a, const Enclosure106& b) {
    const double divisor = size(b) * (1.0 - 0x1p-40) - b.radius_ * (1.0 + 0x1p-40);
    if (!(divisor > 0x1p-300 && size(b) < 0x1p300)) return {DoubleDouble(0.0), std::numeric_limits<double>::infinity()};
    const DoubleDouble quotient = a.middle_ / b.middle_;
    return made(quotient, (a.radius_ + std::abs(quotient.hi) * b.radius_) / divisor + k_least / divisor);
  }
  // Root of the part that is not negative. |sqrt(x) - sqrt(m)| <= |x - m| / sqrt(m)
  friend Enclosure106 sqrt(const Enclosure106& a) {
    if (a.middle_.hi > 0x1p-600 && a.middle_.hi * (1.0 - 0x1p-40) > a.radius_) {
      const DoubleDouble root = sqrt(a.middle_);
      return made(root, a.radius_ / root.hi);
    }
    const double half = 0.5 * std::sqrt(std::max(0.0, a.middle_.hi) * (1.0 + 0x1p-40) + a.radius_ + k_least);
    return made(DoubleDouble(half), half);
  }
  Enclosure106& operator+=(const Enclosure106& b) { return *this = *this + b; }

  // Certainly less. False if a radius is infinite or unknown.
  friend bool operator<(const Enclosure106& a, const Enclosure106& b) {
    const DoubleDouble difference = b.middle_ - a.middle_;
    return difference.hi * (1.0 - 0x1p-40) > (a.radius_ + b.radius_) * (1.0 + 0x1p-40) + k_least;
  }
  friend bool operator>(const Enclosure106& a, const Enclosure106& b) { return b < a; }
  friend bool operator==(const Enclosure106& a, const Enclosure106& b) {
    return a.radius_ == 0.0 && b.radius_ == 0.0 && a.middle_ == b.middle_;
  }

 private:
  // More than the loss of products and quotients by underflow, with factors below 2^300.
  static constexpr double k_least = 0x1p-700;

  static double size(const Enclosure106& a) { return std::abs(a.middle_.hi) * (1.0 + 0x1p-40); }
  // A result is assumed to be right to 64 u² (geom/numbers/double_double.h). The radius itself is the result of a few
  // rounded operations.
  static Enclosure106 made(const DoubleDouble& middle, double radius) {
    if (!std::isfinite(middle.hi)) return {DoubleDouble(0.0), std::numeric_limits<double>::infinity()};
    if (radius == 0.0 && middle.hi == 0.0 && middle.lo == 0.0) return {middle, k_least};
    return {middle, (radius + std::abs(middle.hi) * 0x1p-100) * (1.0 + 0x1p-40) + k_least};
  }

  DoubleDouble middle_;
  double radius_ = 0.0;
};

struct Angle106 {
  Enclosure106 cosine, sine;
};

// Of 0 <= x < 2. Terms of the exponential series until the rest, less than twice the next one, is negligible beside x.
inline Angle106 angle_106(const Enclosure106& x) {
  Enclosure106 term(1.0), sums[2] = {term, Enclosure106(0.0)};
  int n = 1;
  for (; n < 46 && std::abs(term.middle().hi) > 0x1p-130 * x.middle().hi; ++n) {
    term = term * x / Enclosure106(static_cast<double>(n));
    sums[n % 2] = n % 4 < 2 ? sums[n % 2] + term : sums[n % 2] - term;
  }
  const Enclosure106 rest(DoubleDouble(0.0), 4.0 * (std::abs(term.middle().hi) + term.radius()));
  return {sums[0] + rest, sums[1] + rest};
}

template <>
struct Precision<Enclosure106> {
  static constexpr int k_root_bits = 90;
};

inline Roots<Enclosure106> roots_of(const Polynomial<Enclosure106>& polynomial, int bits) {
  return RootSearch<Enclosure106>(polynomial, bits).run();
}

inline DoubleDouble cos(const DoubleDouble& angle) {
  return angle_106(Enclosure106(angle)).cosine.middle();
}
inline DoubleDouble sin(const DoubleDouble& angle) {
  return angle_106(Enclosure106(angle)).sine.middle();
}

}  // namespace clusterbench::geom
