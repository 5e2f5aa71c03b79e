#include "geom/enclosure.h"

#include <cmath>
#include <limits>
#include <vector>

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
double at_most(const Middle& value) {
  return std::max(0.0, std::abs(static_cast<double>(value)) * (1.0 - 0x1p-40) - 16.0 * k_least);
}

// What rounding a middle to 1024 bits can have cost, four times over.
double rounding_of(const Middle& value) {
  return value == 0 ? 0.0 : at_least(value) * 0x1p-1020;
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
  return made(a.middle_ * b.middle_,
              at_least(a.middle_) * b.radius_ + at_least(b.middle_) * a.radius_ + a.radius_ * b.radius_);
}

// |a/b - a'/b'| = |(a - a') b' - a' (b - b')| / |b b'| <= (radius of a + |a'/b'| * radius of b) / |b|
Enclosure operator/(const Enclosure& a, const Enclosure& b) {
  const double divisor = at_most(b.middle_) - rounded_up(b.radius_);
  if (!(divisor > 0.0 && a.radius_ < k_infinity)) return nothing_known();
  const Middle quotient = a.middle_ / b.middle_;
  const double widest = rounded_up(a.radius_ + at_least(quotient) * b.radius_);
  return made(quotient, widest == 0.0 ? 0.0 : rounded_up(widest / (divisor * (1.0 - 0x1p-40))));
}

// |sqrt(x) - sqrt(m)| = |x - m| / (sqrt(x) + sqrt(m)) <= |x - m| / sqrt(m)
Enclosure sqrt(const Enclosure& a) {
  if (!(a.radius_ < k_infinity)) return nothing_known();
  if (at_most(a.middle_) > a.radius_ && a.middle_ > 0) {
    const Middle root = sqrt(a.middle_);
    return made(root, rounded_up(a.radius_ / at_most(root)));
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

namespace {

// Halves [-1, 1] until pieces hold no root for certain or are narrow, with Newton's steps where the slope has one sign.
class RootSearch {
 public:
  RootSearch(const Polynomial<Enclosure>& polynomial, int bits)
      : polynomial_(polynomial), derivative_(polynomial.derivative()), narrow_(ldexp(Middle(1), -bits)) {}

  Places<Enclosure> run() {
    open_ = {{-1, 1}};
    constexpr int k_most_steps = 3000;
    int steps = 0;
    for (; !open_.empty() && steps < k_most_steps; ++steps) {
      const Piece piece = open_.back();
      open_.pop_back();
      step(piece);
    }
    Places<Enclosure> places;
    if (!open_.empty() || found_.size() > places.at.size()) {
      places.add(Enclosure::of(Middle(-1), Middle(1)));
      return places;
    }
    for (const Piece& piece : found_) places.add(Enclosure::of(piece.lo, piece.hi));
    return places;
  }

 private:
  struct Piece {
    Middle lo, hi;
  };

  static bool is_surely_not_zero(const Enclosure& value) { return value < Enclosure(0.0) || value > Enclosure(0.0); }

  // Values over a piece by the mean value theorem, over and over: near a multiple root the piece's width counts only as
  // much as the slope there does.
  static Enclosure values_over(const Polynomial<Enclosure>& polynomial, const Enclosure& middle, const Enclosure& t) {
    Enclosure value = polynomial.value_at(middle);
    if (polynomial.degree == 0) return value;
    return value + values_over(polynomial.derivative(), middle, t) * (t - middle);
  }

  void step(const Piece& piece) {
    const Enclosure t = Enclosure::of(piece.lo, piece.hi), middle(t.middle(), 0.0);
    const Enclosure slope = values_over(derivative_, middle, t), value = polynomial_.value_at(middle);
    if (is_surely_not_zero(value + slope * (t - middle))) return;
    const Middle width = piece.hi - piece.lo;
    if (width <= narrow_) return add(piece);
    if (is_surely_not_zero(slope)) {
      const Enclosure newton = middle - value / slope;
      const Middle radius(newton.radius());
      const Piece cut{std::max(piece.lo, Middle(newton.middle() - 2 * radius)),
                      std::min(piece.hi, Middle(newton.middle() + 2 * radius))};
      if (cut.lo > cut.hi) return;
      if (2 * (cut.hi - cut.lo) < width) return open_.push_back(cut);
    }
    open_.push_back({t.middle(), piece.hi});
    open_.push_back({piece.lo, t.middle()});
  }

  // Pieces come in ascending order.
  void add(const Piece& piece) {
    if (!found_.empty() && found_.back().hi >= piece.lo)
      found_.back().hi = piece.hi;
    else
      found_.push_back(piece);
  }

  const Polynomial<Enclosure>& polynomial_;
  const Polynomial<Enclosure> derivative_;
  const Middle narrow_;
  std::vector<Piece> open_, found_;
};

}  // namespace

Places<Enclosure> root_places(const Polynomial<Enclosure>& polynomial, int bits) {
  return RootSearch(polynomial, bits).run();
}

}  // namespace clusterbench::geom
