#include "geom/enclosure.h"

#include <cmath>
#include <limits>

#include "geom/root_search.h"

namespace clusterbench::geom {
namespace {

using Middle = Enclosure::Middle;

constexpr double k_infinity = std::numeric_limits<double>::infinity();
constexpr double k_least = std::numeric_limits<double>::denorm_min();

// Sums, products and quotients of a few non-negative doubles are rounded by far less than this factor.
double rounded_up(double value) {
  return value * (1.0 + 0x1p-40) + 16.0 * k_least;
}
double at_least(const Middle& value) {
  return rounded_up(std::abs(static_cast<double>(value)));
}
// What is beyond the largest double counts as that: as infinity it would make every radius beside it nothing.
double at_most(const Middle& value) {
  const double size = std::min(std::abs(static_cast<double>(value)), std::numeric_limits<double>::max());
  return std::max(0.0, size * (1.0 - 0x1p-40) - 16.0 * k_least);
}

// What rounding a middle to 1024 bits can have cost, four times over; never nothing, however small the middle is.
double rounding_of(const Middle& value) {
  return value == 0 ? 0.0 : rounded_up(at_least(value) * 0x1p-1020);
}

// A sum of products of radii: only if there are none is it nothing.
double unless_exact(double sum, double radius_a, double radius_b) {
  return radius_a == 0.0 && radius_b == 0.0 ? 0.0 : rounded_up(sum);
}

Enclosure nothing_known() {
  return {0, k_infinity};
}

Enclosure made(const Middle& middle, double radius) {
  const double total = radius + rounding_of(middle);
  return {middle, total == 0.0 ? 0.0 : rounded_up(total)};
}

}  // namespace

Enclosure Enclosure::of(const Rational& value) {
  // Numerator, denominator and quotient are rounded.
  const Middle middle = Middle(numerator(value)) / Middle(denominator(value));
  return {middle, 4.0 * rounding_of(middle)};
}

Enclosure Enclosure::of(const RationalInterval& bounds) {
  const Enclosure lo = of(bounds.lo), hi = of(bounds.hi);
  return made(lo.middle_, at_least(hi.middle_ - lo.middle_) + lo.radius_ + hi.radius_);
}

Enclosure Enclosure::of(const Middle& lo, const Middle& hi) {
  const Middle middle = (lo + hi) / 2;
  return made(middle, at_least(hi - lo) / 2.0);
}

Enclosure operator+(const Enclosure& a, const Enclosure& b) {
  return made(a.middle_ + b.middle_, a.radius_ + b.radius_);
}

Enclosure operator-(const Enclosure& a, const Enclosure& b) {
  return made(a.middle_ - b.middle_, a.radius_ + b.radius_);
}

Enclosure operator*(const Enclosure& a, const Enclosure& b) {
  if (!(a.radius_ < k_infinity && b.radius_ < k_infinity)) return nothing_known();
  const double sum = at_least(a.middle_) * b.radius_ + at_least(b.middle_) * a.radius_ + a.radius_ * b.radius_;
  return made(a.middle_ * b.middle_, unless_exact(sum, a.radius_, b.radius_));
}

// |a/b - a'/b'| = |(a - a') b' - a' (b - b')| / |b b'| <= (radius of a + |a'/b'| * radius of b) / |b|
Enclosure operator/(const Enclosure& a, const Enclosure& b) {
  const double divisor = at_most(b.middle_) - rounded_up(b.radius_);
  if (!(divisor > 0.0 && a.radius_ < k_infinity)) return nothing_known();
  const Middle quotient = a.middle_ / b.middle_;
  const double widest = unless_exact(a.radius_ + at_least(quotient) * b.radius_, a.radius_, b.radius_);
  return made(quotient, widest == 0.0 ? 0.0 : rounded_up(widest / (divisor * (1.0 - 0x1p-40))));
}

// |sqrt(x) - sqrt(m)| = |x - m| / (sqrt(x) + sqrt(m)) <= |x - m| / sqrt(m)
Enclosure sqrt(const Enclosure& a) {
  if (!(a.radius_ < k_infinity)) return nothing_known();
  if (at_most(a.middle_) > a.radius_ && a.middle_ > 0) {
    const Middle root = sqrt(a.middle_);
    return made(root, a.radius_ == 0.0 ? 0.0 : rounded_up(a.radius_ / at_most(root)));
  }
  const Middle highest = a.middle_ + Middle(rounded_up(a.radius_));
  if (highest <= 0) return Enclosure(0.0);
  const Middle half = sqrt(highest) / 2;
  return made(half, at_least(half));
}

bool operator<(const Enclosure& a, const Enclosure& b) {
  const Middle difference = b.middle_ - a.middle_;
  return difference > 0 && at_most(difference) > rounded_up(a.radius_ + b.radius_);
}

Places<Enclosure> root_places(const Polynomial<Enclosure>& polynomial, int bits) {
  return RootSearch<Enclosure>(polynomial, bits).run();
}

}  // namespace clusterbench::geom
