// Where spots lean most to the left and to the right, or up and down, between planes: in single precision and without
// proof. For files that are compiled once per target; included after hwy/highway.h; defines its names anew for each
// target.

#if defined(CLUSTERBENCH_SPOT_EXTREMES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLUSTERBENCH_SPOT_EXTREMES_INL_H
#undef CLUSTERBENCH_SPOT_EXTREMES_INL_H
#else
#define CLUSTERBENCH_SPOT_EXTREMES_INL_H
#endif

#include "assign/cone/spot_cell_filter-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {

HWY_INLINE V square_of(V x) {
  return x * x;
}
HWY_INLINE V inverse(V x) {
  return all(1.0f) / x;
}

// A point as the eye sees it: x / depth, y / depth, depth.
struct ProjectedPoint {
  V across, up, depth;

  HWY_INLINE Point point() const { return {across * depth, up * depth, depth}; }
};
HWY_INLINE ProjectedPoint projected(const Point& p, V inverse_depth) {
  return {p.x * inverse_depth, p.y * inverse_depth, p.depth};
}
HWY_INLINE ProjectedPoint projected(const Point& p) {
  return projected(p, inverse(p.depth));
}
HWY_INLINE ProjectedPoint chosen(M where, const ProjectedPoint& a, const ProjectedPoint& b) {
  return {IfThenElse(where, a.across, b.across), IfThenElse(where, a.up, b.up), IfThenElse(where, a.depth, b.depth)};
}

// The two points found so far that lean most across.
struct Extremes {
  ProjectedPoint low, high;

  HWY_INLINE Extremes() : low{all(k_none), all(0.0f), all(1.0f)}, high{all(-k_none), all(0.0f), all(1.0f)} {}

  HWY_INLINE void take_low(M where, const ProjectedPoint& p) {
    low = chosen(And(where, p.across < low.across), p, low);
  }
  HWY_INLINE void take_high(M where, const ProjectedPoint& p) {
    high = chosen(And(where, p.across > high.across), p, high);
  }
  HWY_INLINE void take(M where, const ProjectedPoint& p) {
    take_low(where, p);
    take_high(where, p);
  }
  HWY_INLINE M exist() const { return low.across < all(k_none); }

  static constexpr float k_none = 1e15f;
};

// Spots and what follows from them alone. Places count that are outside by less than the slack.
struct SpotShapes {
  Cone cone;
  V slack;
  Point m1, m2;           // unit vectors across the axis
  Point rim, rim1, rim2;  // its middle, and from there to two of its points
  V least_along;          // the axis, of points of the sphere that are in the cone

  SpotShapes() = default;
  HWY_INLINE SpotShapes(const Cone& of_cone, V of_slack) : cone(of_cone), slack(of_slack) {
    const Point toward = Point{all(0.3f), all(0.5f), all(0.8f)}, other = Point{all(0.8f), all(-0.5f), all(0.1f)};
    const V along = dot(toward, cone.axis);
    const M is_good = Abs(along) < all(0.9f);
    const Point from = chosen(is_good, toward, other);
    const Point part = from - dot(from, cone.axis) * cone.axis;
    m1 = inverse(length(part)) * part;
    m2 = cross(cone.axis, m1);
    const V forth = cone.range * cone.cosine, out = cone.range * cone.sine;
    rim = cone.apex + forth * cone.axis;
    rim1 = out * m1;
    rim2 = out * m2;
    least_along = forth - slack * cone.sine;
  }

  // The same with x and y exchanged: what leans most across is then what leans most up and down.
  HWY_INLINE SpotShapes exchanged() const {
    const auto turned = [](const Point& p) { return Point{p.y, p.x, p.depth}; };
    SpotShapes other;
    other.cone = {turned(cone.apex), turned(cone.axis), cone.range, cone.cosine, cone.sine};
    other.slack = slack;
    other.m1 = turned(m1);
    other.m2 = turned(m2);
    other.rim = turned(rim);
    other.rim1 = turned(rim1);
    other.rim2 = turned(rim2);
    other.least_along = least_along;
    return other;
  }

  // Is a point of the sphere in the cone that is so far along the axis from the apex?
  HWY_INLINE M is_in_cone(V along) const { return along >= least_along; }
  HWY_INLINE M is_sphere_in_cone(const Point& p) const { return is_in_cone(dot(p - cone.apex, cone.axis)); }

  // Angles phi with a cos phi + b sin phi = c, as points of the rim.
  template <class Take>
  HWY_INLINE void each_rim_point(V a, V b, V c, Take&& take) const {
    const V square = square_of(a) + square_of(b), rest = square - square_of(c);
    const M exists = And(rest >= Zero(D()), square > Zero(D()));
    const V w = root(rest), scale = inverse(square);
    for (const V turned : {w, Neg(w)}) {
      const V cosine = scale * (a * c - b * turned);
      const V sine = scale * (b * c + a * turned);
      take(exists, rim + cosine * rim1 + sine * rim2);
    }
  }

  // The generators in which planes through the apex that hold a direction touch the cone. Where there are none, not
  // numbers.
  HWY_INLINE void find_generators(const Point& direction, Point (&generators)[2]) const {
    const V along = dot(direction, cone.axis), a = dot(direction, m1), b = dot(direction, m2);
    const V square = square_of(a) + square_of(b);
    const V c = cone.sine / Max(cone.cosine, all(1e-6f)) * along;
    const V w = Sqrt(square - square_of(c)), scale = cone.sine * inverse(square);
    const V turned[2] = {w, Neg(w)};
    for (int i = 0; i < 2; ++i) {
      const V to1 = scale * (a * c - b * turned[i]);
      const V to2 = scale * (b * c + a * turned[i]);
      generators[i] = cone.cosine * cone.axis + to1 * m1 + to2 * m2;
    }
  }
  // So far from the apex.
  HWY_INLINE M is_on_generator(V t) const { return is_between(Zero(D()), t, cone.range + slack); }

  // The points of the sphere as far to the left and to the right of the apex, `up` and `ahead` from there: where they
  // are and whether they exist.
  template <class TakeLow, class TakeHigh>
  HWY_INLINE void each_sphere_point(V up, V ahead, TakeLow&& take_low, TakeHigh&& take_high) const {
    const V square = square_of(cone.range) - (square_of(up) + square_of(ahead)), half = root(square);
    const V middle = up * cone.axis.y + ahead * cone.axis.depth;
    const V lean = half * cone.axis.x;
    const M exist = square >= Zero(D());
    take_low(And(exist, is_in_cone(middle - lean)), cone.apex.x - half);
    take_high(And(exist, is_in_cone(middle + lean)), cone.apex.x + half);
  }
};

// Two planes across the view axis.
struct SlicePlanes {
  V near, far, inverse_near, inverse_far;

  HWY_INLINE M hold(V depth, V slack) const { return is_between(near - slack, depth, far + slack); }
};

// What of spots between two slice planes can lean most across, wherever it is up and down: take.both(where, point), or
// take.low and take.high for what can do so to one side only.
struct SlotCounts {
  int low, high, both;
};
inline constexpr SlotCounts k_slots_in_slice = {3, 3, 11};
template <class Take>
HWY_INLINE void each_point_in_slice(const SpotShapes& spots, const SlicePlanes& planes, Take& take) {
  const Point& a = spots.cone.apex;
  const V zero = Zero(D());
  take.both(planes.hold(a.depth, spots.slack), projected(a));

  // The sphere's tangents at the apex's height.
  const V range_square = square_of(spots.cone.range), square = square_of(a.x) + square_of(a.depth);
  const V tangent_square = square - range_square, scale = inverse(square);
  const V turn = scale * root(range_square * tangent_square), shrink = scale * tangent_square;
  const auto tangent = [&](V turned) {
    return Point{shrink * a.x - turned * a.depth, a.y, shrink * a.depth + turned * a.x};
  };
  const auto is_in = [&](const Point& p) {
    return And(tangent_square > zero, And(planes.hold(p.depth, spots.slack), spots.is_sphere_in_cone(p)));
  };
  const Point low = tangent(turn), high = tangent(Neg(turn));
  take.low(is_in(low), projected(low));
  take.high(is_in(high), projected(high));

  // The rim's tangents.
  const auto wedge = [](const Point& p, const Point& q) { return p.x * q.depth - q.x * p.depth; };
  spots.each_rim_point(
      wedge(spots.rim2, spots.rim), wedge(spots.rim, spots.rim1), wedge(spots.rim1, spots.rim2),
      [&](M exists, const Point& p) { take.both(And(exists, planes.hold(p.depth, spots.slack)), projected(p)); });

  // In the slice planes sphere, rim, and the cone's side where upright planes touch it.
  Point generators[2];
  spots.find_generators({zero, all(1.0f), zero}, generators);
  const V lean[2] = {inverse(generators[0].depth), inverse(generators[1].depth)};
  const auto take_in = [&](V depth, V inverse_depth) {
    const V ahead = depth - a.depth, up = a.y * inverse_depth;
    spots.each_sphere_point(
        zero, ahead,
        [&](M exists, V x) {
          take.low(exists, ProjectedPoint{x * inverse_depth, up, depth});
        },
        [&](M exists, V x) {
          take.high(exists, ProjectedPoint{x * inverse_depth, up, depth});
        });
    spots.each_rim_point(spots.rim1.depth, spots.rim2.depth, depth - spots.rim.depth, [&](M exists, const Point& p) {
      take.both(exists, projected({p.x, p.y, depth}, inverse_depth));
    });
    for (int i = 0; i < 2; ++i) {
      const V t = ahead * lean[i];
      const Point p = a + t * generators[i];
      take.both(spots.is_on_generator(t), projected({p.x, p.y, depth}, inverse_depth));
    }
  };
  take_in(planes.near, planes.inverse_near);
  take_in(planes.far, planes.inverse_far);
}

// What leans most in a tile plane, y = slope * depth.
struct PlaneExtremes {
  V low, low_depth, high, high_depth;  // slopes x / depth, and where

  HWY_INLINE PlaneExtremes()
      : low(all(Extremes::k_none)), low_depth(all(1.0f)), high(all(-Extremes::k_none)), high_depth(all(1.0f)) {}

  HWY_INLINE void take_low(M where, V slope, V depth) {
    const M is_lower = And(where, slope < low);
    low = IfThenElse(is_lower, slope, low);
    low_depth = IfThenElse(is_lower, depth, low_depth);
  }
  HWY_INLINE void take_high(M where, V slope, V depth) {
    const M is_higher = And(where, slope > high);
    high = IfThenElse(is_higher, slope, high);
    high_depth = IfThenElse(is_higher, depth, high_depth);
  }
  HWY_INLINE void take(M where, V slope, V depth) {
    take_low(where, slope, depth);
    take_high(where, slope, depth);
  }
  HWY_INLINE M exist() const { return low < all(Extremes::k_none); }

  // One lane on.
  HWY_INLINE PlaneExtremes carried(const Carried& carry, PlaneExtremes& turned) const {
    PlaneExtremes next;
    next.low = carry(low, turned.low);
    next.low_depth = carry(low_depth, turned.low_depth);
    next.high = carry(high, turned.high);
    next.high_depth = carry(high_depth, turned.high_depth);
    return next;
  }
};

// Spots, each in a slice, and what is the same in all of its tile planes.
struct SpotsInSlices {
  SpotShapes shapes;
  SlicePlanes between;
  V light;              // size of the numbers that describe it
  V tangent;            // from the eye to where the sphere's tangents touch
  Point generators[2];  // in which planes through the eye touch the cone
  V inverse_lean;       // 1 / (axis.x² - cosine²)

  SpotsInSlices() = default;
  HWY_INLINE SpotsInSlices(const SpotShapes& of_shapes, const SlicePlanes& of_between, V of_light)
      : shapes(of_shapes), between(of_between), light(of_light) {
    const Cone& cone = shapes.cone;
    tangent = root(dot(cone.apex, cone.apex) - square_of(cone.range));
    shapes.find_generators(cone.apex, generators);
    inverse_lean = inverse(square_of(cone.axis.x) - square_of(cone.cosine));
  }

  // Calls take for each of its vectors, in the same order every time.
  template <class Take>
  HWY_INLINE void each(Take&& take) {
    const auto take_point = [&](Point& p) {
      take(p.x);
      take(p.y);
      take(p.depth);
    };
    for (Point* p : {&shapes.cone.apex, &shapes.cone.axis, &shapes.m1, &shapes.m2, &shapes.rim, &shapes.rim1,
                     &shapes.rim2, &generators[0], &generators[1]})
      take_point(*p);
    for (V* v :
         {&shapes.cone.range, &shapes.cone.cosine, &shapes.cone.sine, &shapes.slack, &shapes.least_along, &between.near,
          &between.far, &between.inverse_near, &between.inverse_far, &light, &tangent, &inverse_lean})
      take(*v);
  }
  static constexpr int k_vectors = 39;

  // `tilt`: sqrt(1 + slope²).
  HWY_INLINE PlaneExtremes in_tile_plane(V slope, V tilt, V inverse_tilt) const {
    PlaneExtremes found;
    take_tangents(slope, tilt, inverse_tilt, found);
    take_rim(slope, found);
    take_generators(slope, found);
    take_edge(slope, between.near, between.inverse_near, found);
    take_edge(slope, between.far, between.inverse_far, found);
    return found;
  }

 private:
  HWY_INLINE void take_tangents(V slope, V tilt, V inverse_tilt, PlaneExtremes& found) const {
    const Point& a = shapes.cone.apex;
    const V range = shapes.cone.range, zero = Zero(D());
    const V away = (a.y - slope * a.depth) * inverse_tilt;
    const V ahead = (slope * a.y + a.depth) * inverse_tilt;
    const V rho_square = (range - away) * (range + away), rho = root(rho_square);
    const M exist = And(rho_square >= zero, tangent > zero);
    const V shrink = tangent * inverse(square_of(a.x) + square_of(ahead));
    const V b = ahead * tangent, c = a.x * rho, d = a.x * tangent, e = ahead * rho;
    const V low_lean = b + c, high_lean = b - c, both = inverse(low_lean * high_lean);
    const V low = tilt * ((d - e) * high_lean * both);
    const V high = tilt * ((d + e) * low_lean * both);
    const V to_depth = shrink * inverse_tilt;
    const auto is_in = [&](V across, V depth) {
      const Point p = ProjectedPoint{across, slope, depth}.point();
      return And(exist, And(between.hold(depth, shapes.slack), shapes.is_sphere_in_cone(p)));
    };
    const V low_depth = to_depth * low_lean, high_depth = to_depth * high_lean;
    found.take_low(is_in(low, low_depth), low, low_depth);
    found.take_high(is_in(high, high_depth), high, high_depth);
  }

  HWY_INLINE void take_rim(V slope, PlaneExtremes& found) const {
    const auto part = [&](const Point& p) { return p.y - slope * p.depth; };
    shapes.each_rim_point(part(shapes.rim1), part(shapes.rim2), Neg(part(shapes.rim)), [&](M exists, const Point& p) {
      found.take(And(exists, between.hold(p.depth, shapes.slack)), p.x / p.depth, p.depth);
    });
  }

  // Where planes through the eye touch the cone's side.
  HWY_INLINE void take_generators(V slope, PlaneExtremes& found) const {
    const Point& a = shapes.cone.apex;
    const V above = slope * a.depth - a.y;
    for (const Point& g : {generators[0], generators[1]}) {
      const V t = above / (g.y - slope * g.depth);
      const V x = a.x + t * g.x, depth = a.depth + t * g.depth;
      found.take(And(shapes.is_on_generator(t), between.hold(depth, shapes.slack)), x / depth, depth);
    }
  }

  // Where sphere and cone's side meet a slice plane: along² = cosine² (x² + rest), along = x axis.x + k.
  HWY_INLINE void take_edge(V slope, V depth, V inverse_depth, PlaneExtremes& found) const {
    const Cone& cone = shapes.cone;
    const V up = slope * depth - cone.apex.y, ahead = depth - cone.apex.depth;
    shapes.each_sphere_point(
        up, ahead, [&](M exists, V x) { found.take_low(exists, x * inverse_depth, depth); },
        [&](M exists, V x) { found.take_high(exists, x * inverse_depth, depth); });
    const V rest = square_of(up) + square_of(ahead);
    const V k = up * cone.axis.y + ahead * cone.axis.depth, cosine_square = square_of(cone.cosine);
    const V qa = square_of(cone.axis.x) - cosine_square, qb = k * cone.axis.x;
    const V qc = square_of(k) - cosine_square * rest;
    // qb² - qa qc, but for wide cones without its cancellation.
    const V inside = square_of(k) + qa * rest, longest_square = square_of(cone.range + shapes.slack);
    const M exist = inside >= Zero(D());
    const V q = Neg(qb + CopySign(cone.cosine * root(inside), qb));
    for (const V x : {q * inverse_lean, qc / q}) {
      const M is_in = And(x * cone.axis.x + k >= Neg(shapes.slack), square_of(x) + rest <= longest_square);
      found.take(And(exist, is_in), (cone.apex.x + x) * inverse_depth, depth);
    }
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
HWY_AFTER_NAMESPACE();

#endif
