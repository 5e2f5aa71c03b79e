#pragma once
// The interval property of a row of cells (one slice, one row of tiles, all columns) of a perspective frustum grid: row
// ∩ ball is convex, and slope x / depth is continuous on it, so the touched columns are one interval, from the least
// slope to the greatest. This file computes both in closed form, over float or double.
//
// Rounding changes a result no more than a shift of the ball's centre or surface by a few unit roundoffs of the
// coordinates. For a certain result, pass a ball that is larger or smaller by more than that, and state which (Errs).
// This matters where the surface passes through the eye up to roundoffs: there, rounding would decide whether tangents
// exist, which touch up to 2^-11 (float) or 2^-25 (double) of the ball's distance away from the eye.

#include <algorithm>
#include <cmath>
#include <limits>

namespace clusterbench::geom {

// An interval of slopes or coordinates that grows with each added value.
template <class Real>
struct SlopeHull {
  Real lo = std::numeric_limits<Real>::infinity(), hi = -std::numeric_limits<Real>::infinity();

  void add(Real value) {
    lo = std::min(lo, value);
    hi = std::max(hi, value);
  }
  bool empty() const { return !(lo <= hi); }
};

// The side on which a result may be wrong: it contains more than the truth (outward), or less (inward).
enum class Errs { outward, inward };

// The disk's squared radius, or one that is larger or smaller by less than 24 unit roundoffs of its squared distance,
// so that the eye is certainly inside or certainly outside.
template <class Real>
Real squared_radius_off_eye(Real squared_radius, Real squared_distance, Errs errs) {
  constexpr Real k_roundoff = std::numeric_limits<Real>::epsilon() / 2, k_close = 24 * k_roundoff;
  if (std::abs(squared_distance - squared_radius) > k_close * squared_distance) return squared_radius;
  return squared_distance * (errs == Errs::outward ? 1 + k_close : 1 - k_close);
}

// Slopes (u ± h) / w of a chord at depth w >= 0.
template <class Real>
void add_chord(SlopeHull<Real>& hull, Real u, Real h, Real w, Real scale) {
  constexpr Real k_infinity = std::numeric_limits<Real>::infinity();
  if (w > 0) {
    hull.add(scale * (u - h) / w);
    hull.add(scale * (u + h) / w);
    return;
  }
  if (u - h <= 0) hull.add(-k_infinity);
  if (u + h >= 0) hull.add(k_infinity);
}

// Adds scale * u'/w' over the disk around (u, w) cut to w0 <= w' <= w1 (w0 >= 0). The extremes are at the tangents from
// the eye if they touch within the slab, and at the ends of the chords at the slab's sides.
template <class Real>
void add_disk(SlopeHull<Real>& hull, Real u, Real w, Real squared_radius, Real w0, Real w1, Real scale, Errs errs) {
  if (!(squared_radius >= 0) || w0 > w1) return;
  const Real squared_distance = u * u + w * w;
  squared_radius = squared_radius_off_eye(squared_radius, squared_distance, errs);
  for (const Real line : {w0, w1}) {
    const Real square = squared_radius - (line - w) * (line - w);
    if (square >= 0) add_chord(hull, u, std::sqrt(square), line, scale);
  }
  const Real radius = std::sqrt(squared_radius), distance = std::sqrt(squared_distance);
  const Real squared_tangent = (distance - radius) * (distance + radius);
  if (!(squared_tangent > 0)) return;
  const Real tangent = std::sqrt(squared_tangent);
  const Real to_depth = tangent / squared_distance;
  for (const Real side : {-radius, radius}) {
    const Real lean = w * tangent - u * side;  // the touch point is to_depth * (u t + w side, lean)
    const Real depth = to_depth * lean;
    if (depth >= w0 && depth <= w1 && depth > 0) hull.add(scale * (u * tangent + w * side) / lean);
  }
}

// A ball relative to the eye: x to the right, y up, depth ahead.
template <class Real>
struct BallFromEye {
  Real x, y, depth, radius;
};

template <class Real>
struct DepthRange {
  Real near, far;
};

// Depths in `range` at which y0 * depth <= y <= y1 * depth.
template <class Real>
DepthRange<Real> depths_between(Real y, Real y0, Real y1, DepthRange<Real> range) {
  const DepthRange<Real> none{1, 0};
  if (y0 > 0) range.far = std::min(range.far, y / y0);
  if (y0 < 0) range.near = std::max(range.near, y / y0);
  if (y1 > 0) range.near = std::max(range.near, y / y1);
  if (y1 < 0) range.far = std::min(range.far, y / y1);
  return (y0 == 0 && y < 0) || (y1 == 0 && y > 0) ? none : range;
}

// Slopes x/depth over ball ∩ {y0*depth <= y <= y1*depth, near <= depth <= far}. For a given depth x is extreme at the y
// nearest to the centre's: the centre's own, or on one of the two planes. Each is a disk.
template <class Real>
SlopeHull<Real> row_slopes(const BallFromEye<Real>& ball, Real y0, Real y1, DepthRange<Real> range, Errs errs) {
  SlopeHull<Real> hull;
  const Real square = ball.radius * ball.radius;
  const DepthRange<Real> level = depths_between(ball.y, y0, y1, range);
  add_disk(hull, ball.x, ball.depth, square, level.near, level.far, Real(1), errs);
  for (const Real slope : {y0, y1}) {
    const Real tilt = std::sqrt(Real(1) + slope * slope);
    const Real away = (ball.y - slope * ball.depth) / tilt;
    add_disk(hull, ball.x, (slope * ball.y + ball.depth) / tilt, (ball.radius - away) * (ball.radius + away),
             range.near * tilt, range.far * tilt, tilt, errs);
  }
  return hull;
}

}  // namespace clusterbench::geom
