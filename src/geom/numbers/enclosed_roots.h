#pragma once
// Places of roots between proven bounds, in numbers that are known to lie between bounds
// (geom/numbers/wide_enclosure.h, geom/numbers/enclosure_106.h).

#include <algorithm>
#include <vector>

#include "geom/numbers/polynomial.h"

namespace clusterbench::geom {

// Halves [-1, 1] until pieces hold no root for certain or are narrow, with Newton's steps where the slope has one sign.
template <class Real>
class RootSearch {
  using Middle = typename Real::Middle;

 public:
  RootSearch(const Polynomial<Real>& polynomial, int bits)
      : polynomial_(polynomial), derivative_(polynomial.derivative()), narrow_(ldexp(Middle(1), -bits)) {}

  Places<Real> run() {
    open_ = {{Middle(-1), Middle(1)}};
    constexpr int k_most_steps = 3000;
    int steps = 0;
    for (; !open_.empty() && steps < k_most_steps; ++steps) {
      const Piece piece = open_.back();
      open_.pop_back();
      step(piece);
    }
    Places<Real> places;
    if (!open_.empty() || found_.size() > places.at.size()) {
      places.add(Real::of(Middle(-1), Middle(1)));
      return places;
    }
    for (const Piece& piece : found_) places.add(Real::of(piece.lo, piece.hi));
    return places;
  }

 private:
  struct Piece {
    Middle lo, hi;
  };

  static bool is_surely_not_zero(const Real& value) { return value < Real(0.0) || value > Real(0.0); }

  // Values over a piece by the mean value theorem, over and over: near a multiple root the piece's width counts only as
  // much as the slope there does.
  static Real values_over(const Polynomial<Real>& polynomial, const Real& middle, const Real& t) {
    Real value = polynomial.value_at(middle);
    if (polynomial.degree == 0) return value;
    return value + values_over(polynomial.derivative(), middle, t) * (t - middle);
  }

  void step(const Piece& piece) {
    const Real t = Real::of(piece.lo, piece.hi), middle(t.middle(), 0.0);
    const Real slope = values_over(derivative_, middle, t), value = polynomial_.value_at(middle);
    if (is_surely_not_zero(value + slope * (t - middle))) return;
    const Middle width = piece.hi - piece.lo;
    if (width <= narrow_) return add(piece);
    if (is_surely_not_zero(slope)) {
      const Real newton = middle - value / slope;
      const Middle radius(newton.radius());
      const Piece cut{std::max(piece.lo, Middle(newton.middle() - Middle(2) * radius)),
                      std::min(piece.hi, Middle(newton.middle() + Middle(2) * radius))};
      if (cut.lo > cut.hi) return;
      if (Middle(2) * (cut.hi - cut.lo) < width) return open_.push_back(cut);
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

  const Polynomial<Real>& polynomial_;
  const Polynomial<Real> derivative_;
  const Middle narrow_;
  std::vector<Piece> open_, found_;
};

}  // namespace clusterbench::geom
