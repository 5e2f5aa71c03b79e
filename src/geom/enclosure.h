#pragma once
// Real numbers between proven bounds: middle ± radius. Arithmetic rounds the middle to 1024 bits and makes the radius
// larger by what that can have cost, so the exact result always lies within. Comparisons say yes only when that is
// certain. Where a divisor may be zero the radius becomes infinite, and nothing is certain any more.

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "geom/bounds.h"
#include "geom/candidates.h"
#include "geom/search.h"

namespace clusterbench::geom {

class Enclosure {
 public:
  using Middle =
      boost::multiprecision::number<boost::multiprecision::cpp_bin_float<1024, boost::multiprecision::digit_base_2>,
                                    boost::multiprecision::et_off>;

  Enclosure() = default;
  explicit Enclosure(double value) : middle_(value) {}
  Enclosure(Middle middle, double radius) : middle_(std::move(middle)), radius_(radius) {}
  static Enclosure of(const Rational& value);
  static Enclosure of(const RationalInterval& bounds);
  static Enclosure of(const Middle& lo, const Middle& hi);

  const Middle& middle() const { return middle_; }
  double radius() const { return radius_; }

  friend Enclosure operator+(const Enclosure& a, const Enclosure& b);
  friend Enclosure operator-(const Enclosure& a, const Enclosure& b);
  friend Enclosure operator*(const Enclosure& a, const Enclosure& b);
  friend Enclosure operator/(const Enclosure& a, const Enclosure& b);
  Enclosure operator-() const { return {-middle_, radius_}; }
  // Of the part that is not negative: for numbers that are known not to be.
  friend Enclosure sqrt(const Enclosure& a);

  // Certainly less, certainly equal.
  friend bool operator<(const Enclosure& a, const Enclosure& b);
  friend bool operator>(const Enclosure& a, const Enclosure& b) { return b < a; }
  friend bool operator==(const Enclosure& a, const Enclosure& b) {
    return a.radius_ == 0.0 && b.radius_ == 0.0 && a.middle_ == b.middle_;
  }

 private:
  Middle middle_ = 0;
  double radius_ = 0.0;
};

template <>
struct Precision<Enclosure> {
  static constexpr int k_place_bits = 400;
};

inline Point3<Enclosure> enclosed(const RationalPoint& p) {
  return {Enclosure::of(p.x), Enclosure::of(p.y), Enclosure::of(p.z)};
}

// Places that together hold all roots in [-1, 1], each about 2^-bits wide or less; or [-1, 1] itself if they cannot be
// told apart. What candidates.h takes for enclosures in place of its own search.
Places<Enclosure> root_places(const Polynomial<Enclosure>& polynomial, int bits);

}  // namespace clusterbench::geom
