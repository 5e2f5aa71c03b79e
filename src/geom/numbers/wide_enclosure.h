#pragma once
// Real numbers between proven bounds: middle ± radius. Arithmetic rounds the middle and enlarges the radius by the
// possible rounding error, so the exact result always lies within. Comparisons say yes only if that is certain. Where a
// divisor may be zero the radius becomes infinite, and nothing is certain any more.

#include "geom/numbers/point3.h"
#include "geom/numbers/polynomial.h"
#include "geom/numbers/precision.h"
#include "geom/numbers/rational_trigonometry.h"
#include "geom/numbers/wide_float.h"

namespace clusterbench::geom {

// The radius type must be able to represent the last digits of the middle: with 1024 bits a double still can.
template <unsigned bits, class RadiusType>
class EnclosureOf {
 public:
  using Middle = BinaryFloat<bits>;
  using Radius = RadiusType;

  EnclosureOf() = default;
  explicit EnclosureOf(double value) : middle_(value) {}
  EnclosureOf(Middle middle, Radius radius) : middle_(std::move(middle)), radius_(std::move(radius)) {}
  static EnclosureOf of(const Rational& value);
  static EnclosureOf of(const RationalInterval& bounds);
  static EnclosureOf of(const Middle& lo, const Middle& hi);

  const Middle& middle() const { return middle_; }
  const Radius& radius() const { return radius_; }

  EnclosureOf operator-() const { return {-middle_, radius_}; }
  friend EnclosureOf operator+(const EnclosureOf& a, const EnclosureOf& b) { return a.plus(b); }
  friend EnclosureOf operator-(const EnclosureOf& a, const EnclosureOf& b) { return a.plus(-b); }
  friend EnclosureOf operator*(const EnclosureOf& a, const EnclosureOf& b) { return a.times(b); }
  friend EnclosureOf operator/(const EnclosureOf& a, const EnclosureOf& b) { return a.over(b); }
  // Root of the part that is not negative: for numbers that are known not to be negative.
  friend EnclosureOf sqrt(const EnclosureOf& a) { return a.root(); }

  // Certainly less, certainly equal.
  friend bool operator<(const EnclosureOf& a, const EnclosureOf& b) { return a.is_surely_below(b); }
  friend bool operator>(const EnclosureOf& a, const EnclosureOf& b) { return b < a; }
  friend bool operator==(const EnclosureOf& a, const EnclosureOf& b) {
    return a.radius_ == 0 && b.radius_ == 0 && a.middle_ == b.middle_;
  }

 private:
  EnclosureOf plus(const EnclosureOf& b) const;
  EnclosureOf times(const EnclosureOf& b) const;
  EnclosureOf over(const EnclosureOf& b) const;
  EnclosureOf root() const;
  bool is_surely_below(const EnclosureOf& b) const;

  Middle middle_ = 0;
  Radius radius_ = 0;
};

using Enclosure1024 = EnclosureOf<1024, double>;
using Enclosure3072 = EnclosureOf<3072, BinaryFloat<64>>;

template <>
struct Precision<Enclosure1024> {
  static constexpr int k_root_bits = 400;
};
template <>
struct Precision<Enclosure3072> {
  static constexpr int k_root_bits = 2000;
};

template <class Interval>
Point3<Interval> enclosed(const RationalPoint& p) {
  return {Interval::of(p.x), Interval::of(p.y), Interval::of(p.z)};
}

// Intervals that together contain all roots in [-1, 1], each about 2^-bits wide or less; or [-1, 1] itself if the roots
// cannot be separated. geom/search/extreme_candidates.h uses this for enclosures in place of polynomial.h.
Roots<Enclosure1024> roots_of(const Polynomial<Enclosure1024>& polynomial, int bits);
Roots<Enclosure3072> roots_of(const Polynomial<Enclosure3072>& polynomial, int bits);

}  // namespace clusterbench::geom
