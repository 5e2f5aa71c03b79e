#pragma once
// The depth at which a pyramid slab is nearest to a point: in doubles, and more precisely in 106 bits.

#include <algorithm>
#include <cmath>

#include "geom/ball/axis_gap.h"
#include "geom/ball/pyramid_slab.h"
#include "geom/numbers/point3.h"

namespace clusterbench::geom {

// Approximate minimum of the squared distance, by Newton's steps, which end after two or three: between the depths
// where the nearest plane changes, the function is a parabola.
inline double nearest_depth(double x, double y, double depth, const PyramidSlab& slab) {
  double at = std::clamp(depth, slab.near, slab.far);
  constexpr int k_most_steps = 8;
  for (int i = 0; i < k_most_steps; ++i) {
    const double slope_x = slope_on(side_of(slab.x0 * at, x, slab.x1 * at), slab.x0, slab.x1);
    const double slope_y = slope_on(side_of(slab.y0 * at, y, slab.y1 * at), slab.y0, slab.y1);
    const double next = std::clamp((depth + slope_x * x + slope_y * y) / (1.0 + slope_x * slope_x + slope_y * slope_y),
                                   slab.near, slab.far);
    if (next == at) break;
    at = next;
  }
  return at;
}

// Half the derivative of a gap's square along depth. A gap whose side is uncertain is smaller than its error, and its
// derivative is smaller than that error times the slope of either plane.
template <class Number>
Number half_slope(const Gap<Number>& gap, float low, float high) {
  const double slope = gap.side == Side::low ? low : gap.side == Side::high ? -static_cast<double>(high) : 0.0;
  const Number product = Number(slope) * gap.size;
  const double error = error_of(gap.size);
  return error > 0.0 ? widened(product, (std::abs(double{low}) + std::abs(double{high})) * error) : product;
}

// An upper bound of a number, at least 0.
inline double most(const Bounded& number) {
  return std::max(0.0, number.error + number.value);
}
inline double most(const Enclosure106& number) {
  return number.radius() + std::max(0.0, number.middle().hi);
}

// The cross-section of a slab at one depth, relative to a centre.
template <class Number>
struct AtDepth {
  Side x, y;
  Number square;
  double steepness;
  double x_error,
      y_error;  // how far the point on such a side can be from the nearest one, where the side is not certain

  // along: relative to the centre's depth.
  AtDepth(const Number& center_x, const Number& center_y, const PyramidSlab& slab, const Number& at,
          const Number& along, Side end) {
    const auto plane = [&](float slope) { return Number(double{slope}) * at; };
    const Gap<Number> gap_x = gap_between(plane(slab.x0), center_x, plane(slab.x1));
    const Gap<Number> gap_y = gap_between(plane(slab.y0), center_y, plane(slab.y1));
    x = gap_x.side;
    y = gap_y.side;
    x_error = error_of(gap_x.size);
    y_error = error_of(gap_y.size);
    square = gap_x.size * gap_x.size + gap_y.size * gap_y.size + along * along;
    // At an end of the slab only a derivative that points away from it leads to smaller values.
    const Number slope = half_slope(gap_x, slab.x0, slab.x1) + half_slope(gap_y, slab.y0, slab.y1) + along;
    const double falls = end != Side::high ? most(-slope) : 0.0;
    const double rises = end != Side::low ? most(slope) : 0.0;
    const double steep = std::max(falls, rises);
    steepness = steep == 0.0 ? 0.0 : bounded::rounded_up(steep);
  }
};

// Is the slab's nearest point certainly at the centre's depth? Then it is computed at that depth, and the vector to it
// is as exact as the coordinates across. This is the case for contacts with planes through the eye's own axes.
inline bool is_level(const Bounded& x, const Bounded& y, const Bounded& depth, const PyramidSlab& slab) {
  const auto is_upright = [&](float low, const Bounded& center, float high) {
    return slope_on(side_of(low * depth.value, center.value, high * depth.value), low, high) == 0.0;
  };
  const bool ends_behind = slab.far == k_infinity || (Bounded(slab.far) - depth).is_surely_above(0.0);
  return ends_behind && (depth - slab.near).is_surely_above(0.0) && is_upright(slab.x0, x, slab.x1) &&
         is_upright(slab.y0, y, slab.y1);
}

inline NearestDepth nearest_between(const Bounded& x, const Bounded& y, const Bounded& depth, const PyramidSlab& slab) {
  NearestDepth nearest;
  nearest.at = nearest_depth(x.value, y.value, depth.value, slab);
  nearest.depth = nearest.at == slab.near ? Side::low : nearest.at == slab.far ? Side::high : Side::between;
  nearest.is_level = depth.error > 0.0 && nearest.at == depth.value && is_level(x, y, depth, slab);
  nearest.evaluated_at = nearest.is_level ? depth : Bounded(nearest.at);
  const Bounded along = nearest.is_level ? Bounded(0.0) : nearest.evaluated_at - depth;
  const AtDepth<Bounded> there(x, y, slab, nearest.evaluated_at, along, nearest.depth);
  nearest.x = there.x;
  nearest.y = there.y;
  nearest.square = there.square;
  nearest.steepness = there.steepness;
  return nearest;
}

// A depth closer to the minimum of the squared distance; still a depth of the slab, as it lies between its ends.
inline Enclosure106 closer_depth(const Enclosure106& x, const Enclosure106& y, const Enclosure106& depth,
                                 const PyramidSlab& slab, const NearestDepth& guess) {
  if (guess.depth != Side::between) return Enclosure106(guess.at);
  const DoubleDouble slope_x(slope_on(guess.x, slab.x0, slab.x1)), slope_y(slope_on(guess.y, slab.y0, slab.y1));
  const DoubleDouble at = (depth.middle() + slope_x * x.middle() + slope_y * y.middle()) /
                          (DoubleDouble(1.0) + slope_x * slope_x + slope_y * slope_y);
  return Enclosure106(DoubleDouble(slab.near) < at && at.hi < slab.far ? at : DoubleDouble(guess.at));
}

inline double undershoot_of(double steepness) {
  return steepness == 0.0 ? 0.0 : bounded::rounded_up(steepness * steepness);
}

// The vector from the centre to the nearest point of the slab. Along depth that point differs from the computed one by
// no more than half the derivative there.
inline Point3<Bounded> way_to(const NearestDepth& nearest, const Bounded& x, const Bounded& y, const Bounded& depth,
                              const PyramidSlab& slab) {
  Bounded way_x =
      across(gap_between(Bounded(slab.x0) * nearest.evaluated_at, x, Bounded(slab.x1) * nearest.evaluated_at));
  Bounded way_y =
      across(gap_between(Bounded(slab.y0) * nearest.evaluated_at, y, Bounded(slab.y1) * nearest.evaluated_at));
  Bounded way_z = nearest.is_level ? Bounded(0.0) : depth - nearest.evaluated_at;
  if (nearest.steepness > 0.0) {
    const auto move = [&](Bounded& part, double slope0, double slope1) {
      part.error = bounded::rounded_up(part.error + nearest.steepness * std::max(std::abs(slope0), std::abs(slope1)));
    };
    move(way_x, slab.x0, slab.x1);
    move(way_y, slab.y0, slab.y1);
    move(way_z, 1.0, 1.0);
  }
  return {way_x, way_y, way_z};
}

}  // namespace clusterbench::geom
