#pragma once
// At which depth a pyramid slab is nearest to a point: in doubles, and closer in 106 bits.

#include <algorithm>
#include <cmath>

#include "geom/ball/axis_gap.h"
#include "geom/ball/pyramid_slab.h"
#include "geom/numbers/point3.h"

namespace clusterbench::geom {

// About where the squared distance is least, by Newton's steps, which end after two or three: between the depths where
// a tile plane begins or ceases to be the nearest thing, it is a parabola.
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

// Half the slope, along depth, of a gap's square. A gap whose side is not certain is below its error, and its slope
// below that times either plane's.
template <class Number>
Number half_slope(const Gap<Number>& gap, float low, float high) {
  const double slope = gap.side == Side::low ? low : gap.side == Side::high ? -static_cast<double>(high) : 0.0;
  const Number product = Number(slope) * gap.size;
  const double error = error_of(gap.size);
  return error > 0.0 ? widened(product, (std::abs(double{low}) + std::abs(double{high})) * error) : product;
}

// How large a number can be, at least 0.
inline double most(const Bounded& number) {
  return std::max(0.0, number.error + number.value);
}
inline double most(const Enclosure106& number) {
  return number.radius() + std::max(0.0, number.middle().hi);
}

// What a slab has at a depth, as a centre sees it.
template <class Number>
struct AtDepth {
  Side x, y;
  Number square;
  double steepness;
  double x_error,
      y_error;  // how far the point on such a side can be from the nearest one, where the side is not certain

  // along: from the centre's depth.
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
    // At an end only a derivative that leads away from it leads lower.
    const Number slope = half_slope(gap_x, slab.x0, slab.x1) + half_slope(gap_y, slab.y0, slab.y1) + along;
    const double falls = end != Side::high ? most(-slope) : 0.0;
    const double rises = end != Side::low ? most(slope) : 0.0;
    const double steep = std::max(falls, rises);
    steepness = steep == 0.0 ? 0.0 : bounded::rounded_up(steep);
  }
};

// Is the slab's nearest point surely as deep as the centre? Then it is looked at there, however deep that is, and the
// way to it is as exact as the coordinates across: so are touches of planes through the eye's own axes.
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
  nearest.looked_at = nearest.is_level ? depth : Bounded(nearest.at);
  const Bounded along = nearest.is_level ? Bounded(0.0) : nearest.looked_at - depth;
  const AtDepth<Bounded> there(x, y, slab, nearest.looked_at, along, nearest.depth);
  nearest.x = there.x;
  nearest.y = there.y;
  nearest.square = there.square;
  nearest.steepness = there.steepness;
  return nearest;
}

// Closer to where the squared distance is least: a depth of the slab, as any is that lies between its ends.
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

// From the centre to the nearest point of the slab, which is no farther from what was looked at along depth than half
// the derivative there.
inline Point3<Bounded> way_to(const NearestDepth& nearest, const Bounded& x, const Bounded& y, const Bounded& depth,
                              const PyramidSlab& slab) {
  Bounded way_x = across(gap_between(Bounded(slab.x0) * nearest.looked_at, x, Bounded(slab.x1) * nearest.looked_at));
  Bounded way_y = across(gap_between(Bounded(slab.y0) * nearest.looked_at, y, Bounded(slab.y1) * nearest.looked_at));
  Bounded way_z = nearest.is_level ? Bounded(0.0) : depth - nearest.looked_at;
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
