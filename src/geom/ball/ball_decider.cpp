#include "geom/ball/ball_decider.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "geom/ball/axis_gap.h"
#include "geom/ball/exact_slab.h"
#include "geom/ball/nearest_depth.h"
#include "geom/ball/pyramid_view_from.h"
#include "geom/ball/rational_ball.h"
#include "geom/shapes/verdict.h"

namespace clusterbench::geom {
namespace {

// Numbers whose products Enclosure106 can bound.
bool fit_106_bits(std::initializer_list<double> numbers) {
  return std::ranges::all_of(numbers, [](double number) { return std::abs(number) < 0x1p60; });
}
bool fits_106_bits(const Placement& center, double radius) {
  const Vec3d &p = center.position, &o = center.origin;
  return fit_106_bits({p.x, p.y, p.z, o.x, o.y, o.z, radius});
}
bool fits_106_bits(const FrustumCell& cell) {
  return fit_106_bits({cell.x0, cell.x1, cell.y0, cell.y1, cell.depth0, cell.depth1});
}
bool fits_106_bits(const ShellCell& cell) {
  return fit_106_bits({cell.x0, cell.x1, cell.y0, cell.y1, cell.distance0, cell.distance1});
}
bool fits_106_bits(const Box& cell) {
  return fit_106_bits({cell.lo.x, cell.lo.y, cell.lo.z, cell.hi.x, cell.hi.y, cell.hi.z});
}

// Half of the middle's leading part is less than the whole middle; the difference is larger than the rounding here.
Verdict verdict_of(const Enclosure106& excess, double undershoot) {
  const double half = 0.5 * excess.middle().hi;
  if (-half >= excess.radius()) return Verdict::yes;
  return half > undershoot + excess.radius() ? Verdict::no : Verdict::uncertain;
}

}  // namespace

BallDecider::BallDecider(const Placement& center, double radius)
    : placement_(center), radius_(radius), squared_radius_(Bounded(radius) * radius) {
  assert(radius >= 0.0 && std::isfinite(radius));
  Bounded from_origin[3], local[3];
  for (int i = 0; i < 3; ++i) from_origin[i] = Bounded(center.position[i]) - center.origin[i];
  for (int row = 0; row < 3; ++row)
    local[row] = Bounded(center.rotation[0][row]) * from_origin[0] + Bounded(center.rotation[1][row]) * from_origin[1] +
                 Bounded(center.rotation[2][row]) * from_origin[2];
  x_ = local[0];
  y_ = local[1];
  depth_ = -local[2];
  center_ = {local[0], local[1], local[2]};
}

const BallDecider::In106Bits& BallDecider::in_106_bits() const {
  if (in_106_bits_) return *in_106_bits_;
  Enclosure106 from_origin[3];
  for (int i = 0; i < 3; ++i)
    from_origin[i] = Enclosure106(placement_.position[i]) - Enclosure106(placement_.origin[i]);
  const auto coordinate = [&](int row) {
    return Enclosure106(placement_.rotation[0][row]) * from_origin[0] +
           Enclosure106(placement_.rotation[1][row]) * from_origin[1] +
           Enclosure106(placement_.rotation[2][row]) * from_origin[2];
  };
  const Enclosure106 radius(radius_);
  in_106_bits_.emplace(In106Bits{coordinate(0), coordinate(1), -coordinate(2), radius * radius});
  return *in_106_bits_;
}

const BallDecider::InDyadics& BallDecider::in_dyadics() const {
  if (in_dyadics_) return *in_dyadics_;
  Dyadic from_origin[3];
  for (int i = 0; i < 3; ++i) from_origin[i] = Dyadic(placement_.position[i]) - Dyadic(placement_.origin[i]);
  const auto coordinate = [&](int row) {
    return Dyadic(placement_.rotation[0][row]) * from_origin[0] + Dyadic(placement_.rotation[1][row]) * from_origin[1] +
           Dyadic(placement_.rotation[2][row]) * from_origin[2];
  };
  in_dyadics_.emplace(InDyadics{coordinate(0), coordinate(1), -coordinate(2), squared(Dyadic(radius_))});
  return *in_dyadics_;
}

template <class AnyCell, class Close, class Exact>
bool BallDecider::decided(const AnyCell& cell, Close&& close, Exact&& exact) const {
  ++exact_decisions_;
  if (fits_106_bits(placement_, radius_) && fits_106_bits(cell)) {
    const Verdict verdict = close(in_106_bits());
    if (verdict != Verdict::uncertain) return verdict == Verdict::yes;
  }
  try {
    return exact(in_dyadics());
  } catch (const TooWide&) {
    return ball_meets_exactly(placement_, radius_, cell);
  }
}

bool BallDecider::meets(const Box& cell) const {
  const auto square = [](const Bounded& lo, const Bounded& at, const Bounded& hi) {
    const Bounded gap = gap_between(lo, at, hi).size;
    return gap * gap;
  };
  const Bounded excess = square(cell.lo.x, x_, cell.hi.x) + square(cell.lo.y, y_, cell.hi.y) +
                         square(-cell.hi.z, depth_, -cell.lo.z) - squared_radius_;
  if (excess.is_surely_not_above(0.0)) return true;
  if (excess.is_surely_above(0.0)) return false;
  const auto close = [&](const In106Bits& ball) {
    const auto close_square = [](double lo, const Enclosure106& at, double hi) {
      const Enclosure106 gap = gap_between(Enclosure106(lo), at, Enclosure106(hi)).size;
      return gap * gap;
    };
    return verdict_of(close_square(cell.lo.x, ball.x, cell.hi.x) + close_square(cell.lo.y, ball.y, cell.hi.y) +
                          close_square(-cell.hi.z, ball.depth, -cell.lo.z) - ball.squared_radius,
                      0.0);
  };
  return decided(cell, close, [&](const InDyadics& ball) {
    const auto exact_square = [](double lo, const Dyadic& at, double hi) {
      if (at < Dyadic(lo)) return squared(Dyadic(lo) - at);
      return at > Dyadic(hi) ? squared(at - Dyadic(hi)) : Dyadic();
    };
    return exact_square(cell.lo.x, ball.x, cell.hi.x) + exact_square(cell.lo.y, ball.y, cell.hi.y) +
               exact_square(-cell.hi.z, ball.depth, -cell.lo.z) <=
           ball.squared_radius;
  });
}

bool BallDecider::meets(const FrustumCell& cell) const {
  if (cell.orthographic) return meets(Box{{cell.x0, cell.y0, -cell.depth1}, {cell.x1, cell.y1, -cell.depth0}});
  const PyramidSlab slab{cell.x0, cell.x1, cell.y0, cell.y1, cell.depth0, cell.depth1};
  const NearestDepth nearest = nearest_between(x_, y_, depth_, slab);
  const Bounded excess = nearest.square - squared_radius_;
  if (excess.is_surely_not_above(0.0)) return true;
  if (excess.is_surely_above(nearest.undershoot())) return false;
  const auto close = [&](const In106Bits& ball) {
    const Enclosure106 at = closer_depth(ball.x, ball.y, ball.depth, slab, nearest);
    const AtDepth<Enclosure106> there(ball.x, ball.y, slab, at, at - ball.depth, nearest.depth);
    return verdict_of(there.square - ball.squared_radius, undershoot_of(there.steepness));
  };
  return decided(cell, close, [&](const InDyadics& ball) {
    const ExactSlab exact(ball.x, ball.y, ball.depth, slab);
    return exact.is_within(exact.nearest(nearest), ball.squared_radius);
  });
}

PyramidView BallDecider::view_of(const ShellCell& cell) const {
  return view_from(x_, y_, depth_, pyramid_of(cell));
}

bool BallDecider::meets(const ShellCell& cell, const PyramidView& view) const {
  const Bounded near(cell.distance0), far(cell.distance1);
  Bounded further;
  if (view.is_behind) {
    further = near * near - Bounded(2.0) * near * view.along;
  } else {
    const Bounded gap = gap_between(near, view.along, far).size;
    further = gap * gap;
  }
  const Bounded excess = view.nearest.square + further - squared_radius_;
  if (excess.is_surely_not_above(0.0)) return true;
  if (excess.is_surely_above(view.nearest.undershoot())) return false;
  const auto close = [&](const In106Bits& ball) {
    const PyramidSlab pyramid = pyramid_of(cell);
    if (view.is_behind) {
      const AtDepth<Enclosure106> at_eye(ball.x, ball.y, pyramid, Enclosure106(0.0), -ball.depth, Side::low);
      const Enclosure106 t(double{cell.distance0});
      const Enclosure106 along = widened(along_rays(ball.x, ball.y, ball.depth, pyramid), at_eye.steepness);
      return verdict_of(at_eye.square + t * t - Enclosure106(2.0) * t * along - ball.squared_radius,
                        undershoot_of(at_eye.steepness));
    }
    const Enclosure106 at = closer_depth(ball.x, ball.y, ball.depth, pyramid, view.nearest);
    const AtDepth<Enclosure106> there(ball.x, ball.y, pyramid, at, at - ball.depth, view.nearest.depth);
    const auto coordinate = [&](Side side, const Enclosure106& of_center, float low, float high, double error) {
      return widened(side == Side::between ? of_center : Enclosure106(double{side == Side::low ? low : high}) * at,
                     error);
    };
    const Enclosure106 x = coordinate(there.x, ball.x, cell.x0, cell.x1, there.x_error);
    const Enclosure106 y = coordinate(there.y, ball.y, cell.y0, cell.y1, there.y_error);
    const Enclosure106 along = widened(sqrt(x * x + y * y + at * at), there.steepness);
    const Enclosure106 gap =
        gap_between(Enclosure106(double{cell.distance0}), along, Enclosure106(double{cell.distance1})).size;
    return verdict_of(there.square + gap * gap - ball.squared_radius, undershoot_of(there.steepness));
  };
  return decided(cell, close, [&](const InDyadics& ball) {
    return ExactPyramid(ball.x, ball.y, ball.depth, pyramid_of(cell))
        .is_within(view.nearest, Dyadic(cell.distance0), Dyadic(cell.distance1), ball.squared_radius);
  });
}

bool BallDecider::has_corners_in_front(const Point3<double>& normal, const Corners& corners) const {
  try {
    const InDyadics& ball = in_dyadics();
    const Dyadic x(normal.x), y(normal.y), z(normal.z), least = x * ball.x + y * ball.y - z * ball.depth;
    return std::all_of(corners.begin(), corners.end(), [&](const Point3<double>& p) {
      return x * Dyadic(p.x) + y * Dyadic(p.y) + z * Dyadic(p.z) >= least;
    });
  } catch (const TooWide&) {
    return false;
  }
}

bool BallDecider::has_in_front(const Point3<double>& normal, const FrustumCell& cell) const {
  return has_corners_in_front(normal, exact_corners(cell));
}

bool BallDecider::has_in_front(const Point3<double>& normal, const Box& cell) const {
  return has_corners_in_front(normal, exact_corners(cell));
}

// Minimum of normal·(t u) for t between the shells and u a direction of the pyramid. The best u leans most towards the
// opposite of the normal: the minimum is far |q| below 0 for a point q of the pyramid (see view_from), or it is on a
// ray.
bool BallDecider::has_in_front(const Point3<double>& normal, const ShellCell& cell) const {
  try {
    const InDyadics& ball = in_dyadics();
    const Dyadic x(-normal.x), y(-normal.y), depth(normal.z);
    const NearestDepth guess = view_from(-normal.x, -normal.y, normal.z, pyramid_of(cell)).nearest;
    return ExactPyramid(x, y, depth, pyramid_of(cell))
        .is_ahead_at_most(guess, Dyadic(cell.distance0), Dyadic(cell.distance1),
                          x * ball.x + y * ball.y + depth * ball.depth);
  } catch (const TooWide&) {
    return false;
  }
}

bool BallDecider::meets(const Cell& cell) const {
  return std::visit([&](const auto& shape) { return meets(shape); }, cell);
}

}  // namespace clusterbench::geom
