#include "geom/numbers/wide_enclosure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/numbers/enclosed_roots.h"

namespace clusterbench::geom {
namespace {

// Radii: never 0 where something was rounded, however small it is.
template <class Radius>
struct Least;
template <>
struct Least<double> {
  static double value() { return std::numeric_limits<double>::denorm_min(); }
  static double most() { return std::numeric_limits<double>::max(); }
};
template <>
struct Least<BinaryFloat<64>> {
  static BinaryFloat<64> value() { return ldexp(BinaryFloat<64>(1), -1000000); }
  static BinaryFloat<64> most() { return ldexp(BinaryFloat<64>(1), 1000000); }
};

// The rounding of sums, products and quotients of a few non-negative radii is far less than this factor.
template <class Radius>
Radius rounded_up(const Radius& value) {
  return value * (1.0 + 0x1p-40) + 16.0 * Least<Radius>::value();
}
template <class Radius, class Middle>
Radius at_least(const Middle& value) {
  using std::abs;
  return rounded_up<Radius>(abs(static_cast<Radius>(value)));
}
// Values beyond the largest number count as the largest number: infinity would make the radii beside it vanish.
template <class Radius, class Middle>
Radius at_most(const Middle& value) {
  using std::abs;
  const Radius size = std::min(Radius(abs(static_cast<Radius>(value))), Least<Radius>::most());
  return std::max(Radius(0), Radius(size * (1.0 - 0x1p-40) - 16.0 * Least<Radius>::value()));
}

template <class Radius>
bool is_known(const Radius& radius) {
  return radius < std::numeric_limits<Radius>::infinity();
}

// Eight times the largest rounding error of a middle; never 0, however small the middle is.
template <class Radius, unsigned bits>
Radius rounding_of(const BinaryFloat<bits>& value) {
  using std::ldexp;
  if (value == 0) return 0;
  return rounded_up<Radius>(at_least<Radius>(value) * ldexp(Radius(1), 4 - static_cast<int>(bits)));
}

// A sum of products of radii: 0 only if both radii are 0.
template <class Radius>
Radius unless_exact(const Radius& sum, const Radius& radius_a, const Radius& radius_b) {
  return radius_a == 0 && radius_b == 0 ? Radius(0) : rounded_up(sum);
}

template <unsigned bits, class Radius>
EnclosureOf<bits, Radius> made(const BinaryFloat<bits>& middle, const Radius& radius) {
  const Radius total = radius + rounding_of<Radius, bits>(middle);
  return {middle, total == 0 ? Radius(0) : rounded_up(total)};
}

template <class Interval>
Interval nothing_known() {
  return {0, std::numeric_limits<typename Interval::Radius>::infinity()};
}

}  // namespace

template <unsigned bits, class Radius>
EnclosureOf<bits, Radius> EnclosureOf<bits, Radius>::of(const Rational& value) {
  // Numerator, denominator and quotient are rounded.
  const Middle middle = Middle(numerator(value)) / Middle(denominator(value));
  return {middle, 4.0 * rounding_of<Radius, bits>(middle)};
}

template <unsigned bits, class Radius>
EnclosureOf<bits, Radius> EnclosureOf<bits, Radius>::of(const RationalInterval& bounds) {
  const EnclosureOf lo = of(bounds.lo), hi = of(bounds.hi);
  return made<bits, Radius>(lo.middle_, at_least<Radius>(Middle(hi.middle_ - lo.middle_)) + lo.radius_ + hi.radius_);
}

template <unsigned bits, class Radius>
EnclosureOf<bits, Radius> EnclosureOf<bits, Radius>::of(const Middle& lo, const Middle& hi) {
  const Middle middle = (lo + hi) / 2;
  return made<bits, Radius>(middle, at_least<Radius>(Middle(hi - lo)) / 2.0);
}

template <unsigned bits, class Radius>
EnclosureOf<bits, Radius> EnclosureOf<bits, Radius>::plus(const EnclosureOf& b) const {
  return made<bits, Radius>(middle_ + b.middle_, radius_ + b.radius_);
}

template <unsigned bits, class Radius>
EnclosureOf<bits, Radius> EnclosureOf<bits, Radius>::times(const EnclosureOf& b) const {
  if (!is_known(radius_) || !is_known(b.radius_)) return nothing_known<EnclosureOf>();
  const Radius sum =
      at_least<Radius>(middle_) * b.radius_ + at_least<Radius>(b.middle_) * radius_ + radius_ * b.radius_;
  return made<bits, Radius>(middle_ * b.middle_, unless_exact(sum, radius_, b.radius_));
}

// |a/b - a'/b'| = |(a - a') b' - a' (b - b')| / |b b'| <= (radius of a + |a'/b'| * radius of b) / |b|
template <unsigned bits, class Radius>
EnclosureOf<bits, Radius> EnclosureOf<bits, Radius>::over(const EnclosureOf& b) const {
  if (!is_known(radius_) || !is_known(b.radius_)) return nothing_known<EnclosureOf>();
  const Radius divisor = at_most<Radius>(b.middle_) - rounded_up(b.radius_);
  if (!(divisor > 0)) return nothing_known<EnclosureOf>();
  const Middle quotient = middle_ / b.middle_;
  const Radius widest = unless_exact<Radius>(radius_ + at_least<Radius>(quotient) * b.radius_, radius_, b.radius_);
  return made<bits, Radius>(quotient,
                            widest == 0 ? Radius(0) : rounded_up<Radius>(widest / (divisor * (1.0 - 0x1p-40))));
}

// |sqrt(x) - sqrt(m)| = |x - m| / (sqrt(x) + sqrt(m)) <= |x - m| / sqrt(m)
template <unsigned bits, class Radius>
EnclosureOf<bits, Radius> EnclosureOf<bits, Radius>::root() const {
  if (!is_known(radius_)) return nothing_known<EnclosureOf>();
  if (middle_ > 0 && at_most<Radius>(middle_) > radius_) {
    const Middle root = SquareRoot<Middle>::of(middle_);
    return made<bits, Radius>(root, radius_ == 0 ? Radius(0) : rounded_up<Radius>(radius_ / at_most<Radius>(root)));
  }
  const Middle highest = middle_ + Middle(rounded_up(radius_));
  if (highest <= 0) return EnclosureOf(0.0);
  const Middle half = SquareRoot<Middle>::of(highest) / 2;
  return made<bits, Radius>(half, at_least<Radius>(half));
}

template <unsigned bits, class Radius>
bool EnclosureOf<bits, Radius>::is_surely_below(const EnclosureOf& b) const {
  if (!is_known(radius_) || !is_known(b.radius_)) return false;
  const Middle difference = b.middle_ - middle_;
  return difference > 0 && at_most<Radius>(difference) > rounded_up<Radius>(radius_ + b.radius_);
}

template class EnclosureOf<1024, double>;
template class EnclosureOf<3072, BinaryFloat<64>>;

Roots<Enclosure1024> roots_of(const Polynomial<Enclosure1024>& polynomial, int bits) {
  return RootSearch<Enclosure1024>(polynomial, bits).run();
}
Roots<Enclosure3072> roots_of(const Polynomial<Enclosure3072>& polynomial, int bits) {
  return RootSearch<Enclosure3072>(polynomial, bits).run();
}

}  // namespace clusterbench::geom
