#pragma once
// Makes a PyramidView, and a more precise bound of its `along` in 106 bits.

#include <algorithm>
#include <cmath>
#include <optional>

#include "geom/ball/nearest_depth.h"

namespace clusterbench::geom {

// The squared distance from p to t * u (u of unit length) is t² - 2 t (u·p) + |p|². For every t the best u has the
// largest u·p, and then the best t is u·p, clamped between the shells. If the pyramid's point nearest to p, q, is not
// the eye, u = q/|q|, as u·p <= |q| for every u of the pyramid (the pyramid is convex, and p - q is perpendicular to q
// and points away from it). If it is the eye, u·p <= 0 everywhere. Then u is a sum of the four rays (each taken of unit
// length) with weights that add to 1 at least, and one of these rays leans no less towards p than u.
//
// With s half of the derivative at q' (a point at another depth d, nearest to p there), q'·p = |q'|² - d s; so p is
// ahead by |q'| - s at least in the direction of q', and q, for which |p - q|² >= |p - q'|² - s², has |q| <= |q'| +
// |s|.
inline PyramidView view_from(const Bounded& of_x, const Bounded& of_y, const Bounded& of_depth,
                             const PyramidSlab& pyramid) {
  PyramidView view{nearest_between(of_x, of_y, of_depth, pyramid), {}, false};
  const NearestDepth& nearest = view.nearest;
  view.is_behind = nearest.at == 0.0;
  if (view.is_behind) {
    view.along = -k_infinity;
    any_ray(pyramid, [&](float x, float y) {
      const Bounded ahead = Bounded(x) * of_x + Bounded(y) * of_y + of_depth;
      const double length = std::sqrt(1.0 + double{x} * double{x} + double{y} * double{y});
      const double value = ahead.value / length;
      const bool is_zero = ahead.value == 0.0 && ahead.error == 0.0;
      const double error = is_zero ? 0.0 : bounded::rounded_up(ahead.error / length + std::abs(value) * 0x1p-50);
      view.along = larger_of({value, error}, view.along);
      return false;
    });
  } else {
    const auto coordinate = [&](Side side, const Bounded& of_center, float low, float high) {
      if (side == Side::between) return of_center;
      return Bounded(side == Side::low ? low : high) * nearest.evaluated_at;
    };
    const Bounded x = coordinate(nearest.x, of_x, pyramid.x0, pyramid.x1),
                  y = coordinate(nearest.y, of_y, pyramid.y0, pyramid.y1);
    view.along = sqrt(x * x + y * y + nearest.evaluated_at * nearest.evaluated_at);
  }
  if (nearest.steepness > 0.0) view.along.error = bounded::rounded_up(view.along.error + nearest.steepness);
  return view;
}

// The largest component of a point along any of the four rays. Doubles lose less than 2^-48 of the point's size here;
// rays that are worse by more than that are left out.
inline Enclosure106 along_rays(const Enclosure106& x, const Enclosure106& y, const Enclosure106& depth,
                               const PyramidSlab& pyramid) {
  const auto about_ahead = [&](double slope_x, double slope_y) {
    return (slope_x * about(x) + slope_y * about(y) + about(depth)) /
           std::sqrt(1.0 + slope_x * slope_x + slope_y * slope_y);
  };
  double most_about = -k_infinity;
  any_ray(pyramid, [&](float slope_x, float slope_y) {
    most_about = std::max(most_about, about_ahead(slope_x, slope_y));
    return false;
  });
  const double least = most_about - 0x1p-40 * (std::abs(about(x)) + std::abs(about(y)) + std::abs(about(depth)));
  std::optional<Enclosure106> most_ahead;
  any_ray(pyramid, [&](float slope_x, float slope_y) {
    if (about_ahead(slope_x, slope_y) < least) return false;
    const Enclosure106 x_part(double{slope_x}), y_part(double{slope_y});
    const Enclosure106 ahead =
        (x_part * x + y_part * y + depth) / sqrt(Enclosure106(1.0) + x_part * x_part + y_part * y_part);
    if (!most_ahead) {
      most_ahead = ahead;
    } else {
      const bool is_more = most_ahead->middle() < ahead.middle();
      most_ahead =
          Enclosure106(is_more ? ahead.middle() : most_ahead->middle(), std::max(ahead.radius(), most_ahead->radius()));
    }
    return false;
  });
  return *most_ahead;
}

}  // namespace clusterbench::geom
