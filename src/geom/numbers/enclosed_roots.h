#pragma once
// Roots between proven bounds, in numbers that are known to lie between bounds
// (geom/numbers/wide_enclosure.h, geom/numbers/enclosure_106.h).

#include <algorithm>
#include <vector>

#include "geom/numbers/polynomial.h"

namespace clusterbench::geom {

// Bisects [-1, 1] until parts certainly contain no root or are narrow, with Newton's steps where the slope has one
// sign.
template <class Real>
class RootSearch {
  using Middle = typename Real::Middle;

 public:
  RootSearch(const Polynomial<Real>& polynomial, int bits)
      : polynomial_(polynomial), derivative_(polynomial.derivative()), narrow_(ldexp(Middle(1), -bits)) {}

  Roots<Real> run() {
    uncertain_ = {{Middle(-1), Middle(1)}};
    constexpr int k_most_steps = 3000;
    int steps = 0;
    for (; !uncertain_.empty() && steps < k_most_steps; ++steps) {
      const Interval interval = uncertain_.back();
      uncertain_.pop_back();
      step(interval);
    }
    Roots<Real> roots;
    if (!uncertain_.empty() || found_.size() > roots.at.size()) {
      roots.add(Real::of(Middle(-1), Middle(1)));
      return roots;
    }
    for (const Interval& interval : found_) roots.add(Real::of(interval.lo, interval.hi));
    return roots;
  }

 private:
  struct Interval {
    Middle lo, hi;
  };

  static bool is_surely_not_zero(const Real& value) { return value < Real(0.0) || value > Real(0.0); }

  // Values over an interval by the mean value theorem, applied repeatedly: near a multiple root the width is then
  // multiplied only by the small slope there.
  static Real values_over(const Polynomial<Real>& polynomial, const Real& middle, const Real& t) {
    Real value = polynomial.value_at(middle);
    if (polynomial.degree == 0) return value;
    return value + values_over(polynomial.derivative(), middle, t) * (t - middle);
  }

  void step(const Interval& interval) {
    const Real t = Real::of(interval.lo, interval.hi), middle(t.middle(), 0.0);
    const Real slope = values_over(derivative_, middle, t), value = polynomial_.value_at(middle);
    if (is_surely_not_zero(value + slope * (t - middle))) return;
    const Middle width = interval.hi - interval.lo;
    if (width <= narrow_) return add(interval);
    if (is_surely_not_zero(slope)) {
      const Real newton = middle - value / slope;
      const Middle radius(newton.radius());
      const Interval cut{std::max(interval.lo, Middle(newton.middle() - Middle(2) * radius)),
                         std::min(interval.hi, Middle(newton.middle() + Middle(2) * radius))};
      if (cut.lo > cut.hi) return;
      if (Middle(2) * (cut.hi - cut.lo) < width) return uncertain_.push_back(cut);
    }
    uncertain_.push_back({t.middle(), interval.hi});
    uncertain_.push_back({interval.lo, t.middle()});
  }

  // Intervals come in ascending order.
  void add(const Interval& interval) {
    if (!found_.empty() && found_.back().hi >= interval.lo)
      found_.back().hi = interval.hi;
    else
      found_.push_back(interval);
  }

  const Polynomial<Real>& polynomial_;
  const Polynomial<Real> derivative_;
  const Middle narrow_;
  std::vector<Interval> uncertain_, found_;
};

}  // namespace clusterbench::geom
