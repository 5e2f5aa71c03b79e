#pragma once
// Real numbers between proven bounds, as geom/numbers/wide_enclosure.h has them with 1024 bits, here with 106: middle ±
// radius. Enough for all but what touches to within 2^-85 or so, at a hundredth of the time.

#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/numbers/double_double.h"
#include "geom/numbers/enclosed_roots.h"

namespace clusterbench::geom {

class Tight {
 public:
  using Middle = Twofold;

  Tight() = default;
  explicit Tight(double value) : middle_(value) {}
  explicit Tight(const Twofold& value) : middle_(value) {}
  Tight(const Twofold& middle, double radius) : middle_(middle), radius_(radius) {}

  static Tight of(const Twofold& lo, const Twofold& hi) {
    const Twofold half = Twofold(0.5) * (hi - lo);
    return made(Twofold(0.5) * (lo + hi), std::abs(half.hi));
  }

  const Twofold& middle() const { return middle_; }
  double radius() const { return radius_; }

  Tight operator-() const { return {-middle_, radius_}; }
  friend Tight operator+(const Tight& a, const Tight& b) { return made(a.middle_ + b.middle_, a.radius_ + b.radius_); }
  friend Tight operator-(const Tight& a, const Tight& b) { return a + (-b); }
  friend Tight operator*(const Tight& a, const Tight& b) {
    return made(a.middle_ * b.middle_, size(a) * b.radius_ + size(b) * a.radius_ + a.radius_ * b.radius_);
  }
  // |a/b - a'/b'| <= (radius of a + |a'/b'| * radius of b) / |b|
  friend Tight operator/(const Tight& a, const Tight& b) {
    const double divisor = size(b) * (1.0 - 0x1p-40) - b.radius_ * (1.0 + 0x1p-40);
    if (!(divisor > 0x1p-300 && size(b) < 0x1p300)) return {Twofold(0.0), std::numeric_limits<double>::infinity()};
    const Twofold quotient = a.middle_ / b.middle_;
    return made(quotient, (a.radius_ + std::abs(quotient.hi) * b.radius_) / divisor + k_least / divisor);
  }
  // Of the part that is not negative. |sqrt(x) - sqrt(m)| <= |x - m| / sqrt(m)
  friend Tight sqrt(const Tight& a) {
    if (a.middle_.hi > 0x1p-600 && a.middle_.hi * (1.0 - 0x1p-40) > a.radius_) {
      const Twofold root = sqrt(a.middle_);
      return made(root, a.radius_ / root.hi);
    }
    const double half = 0.5 * std::sqrt(std::max(0.0, a.middle_.hi) * (1.0 + 0x1p-40) + a.radius_ + k_least);
    return made(Twofold(half), half);
  }
  Tight& operator+=(const Tight& b) { return *this = *this + b; }

  // Certainly less. An infinite or unknown radius compares to nothing.
  friend bool operator<(const Tight& a, const Tight& b) {
    const Twofold difference = b.middle_ - a.middle_;
    return difference.hi * (1.0 - 0x1p-40) > (a.radius_ + b.radius_) * (1.0 + 0x1p-40) + k_least;
  }
  friend bool operator>(const Tight& a, const Tight& b) { return b < a; }
  friend bool operator==(const Tight& a, const Tight& b) {
    return a.radius_ == 0.0 && b.radius_ == 0.0 && a.middle_ == b.middle_;
  }

 private:
  // More than what products and quotients can lose by underflow, with factors below 2^300.
  static constexpr double k_least = 0x1p-700;

  static double size(const Tight& a) { return std::abs(a.middle_.hi) * (1.0 + 0x1p-40); }
  // A result is right to 15 u²; 64 are taken. The radius itself is a few rounded operations.
  static Tight made(const Twofold& middle, double radius) {
    if (!std::isfinite(middle.hi)) return {Twofold(0.0), std::numeric_limits<double>::infinity()};
    if (radius == 0.0 && middle.hi == 0.0 && middle.lo == 0.0) return {middle, k_least};
    return {middle, (radius + std::abs(middle.hi) * 0x1p-100) * (1.0 + 0x1p-40) + k_least};
  }

  Twofold middle_;
  double radius_ = 0.0;
};

struct TightAngle {
  Tight cosine, sine;
};

// Of 0 <= x < 2. Terms of the exponential series until the rest, less than twice the next one, is nothing beside x.
inline TightAngle tight_angle(const Tight& x) {
  Tight term(1.0), sums[2] = {term, Tight(0.0)};
  int n = 1;
  for (; n < 46 && std::abs(term.middle().hi) > 0x1p-130 * x.middle().hi; ++n) {
    term = term * x / Tight(static_cast<double>(n));
    sums[n % 2] = n % 4 < 2 ? sums[n % 2] + term : sums[n % 2] - term;
  }
  const Tight rest(Twofold(0.0), 4.0 * (std::abs(term.middle().hi) + term.radius()));
  return {sums[0] + rest, sums[1] + rest};
}

template <>
struct Precision<Tight> {
  static constexpr int k_place_bits = 90;
};

inline Places<Tight> root_places(const Polynomial<Tight>& polynomial, int bits) {
  return RootSearch<Tight>(polynomial, bits).run();
}

inline Twofold cos(const Twofold& angle) {
  return tight_angle(Tight(angle)).cosine.middle();
}
inline Twofold sin(const Twofold& angle) {
  return tight_angle(Tight(angle)).sine.middle();
}

}  // namespace clusterbench::geom
