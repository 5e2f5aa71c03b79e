// Candidates for the points where spots extend farthest to the left and right, or up and down, between planes: in
// single precision and without proof. For files that are compiled once per target.

#if defined(CLUSTERBENCH_SPOT_EXTREMES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLUSTERBENCH_SPOT_EXTREMES_INL_H
#undef CLUSTERBENCH_SPOT_EXTREMES_INL_H
#else
#define CLUSTERBENCH_SPOT_EXTREMES_INL_H
#endif

#include "assign/cone/spot_cell_filter-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign::HWY_NAMESPACE {

HWY_INLINE V square_of(V x) {
  return x * x;
}
HWY_INLINE V inverse(V x) {
  return all(1.0f) / x;
}

// Angles phi with a cos phi + b sin phi = c: calls visit(mask where they exist, cosine, sine); elsewhere cosine and
// sine are NaN.
template <class Visit>
HWY_INLINE void each_angle(V a, V b, V c, Visit&& visit) {
  const V square = square_of(a) + square_of(b), rest = square - square_of(c);
  const M exist = And(square > Zero(D()), rest >= Zero(D()));
  const V w = Sqrt(rest), scale = inverse(square);
  for (const V turned : {w, Neg(w)}) visit(exist, scale * (a * c - b * turned), scale * (b * c + a * turned));
}

// A point as the camera sees it: x / w, y / w, depth.
template <bool orthographic>
struct ProjectedPoint {
  V across, up, depth;

  HWY_INLINE Point point() const {
    const V w = w_of<orthographic>(depth);
    return {across * w, up * w, depth};
  }
};
template <bool orthographic>
HWY_INLINE ProjectedPoint<orthographic> projected(const Point& p, V inverse_w) {
  return {p.x * inverse_w, p.y * inverse_w, p.depth};
}
template <bool orthographic>
HWY_INLINE ProjectedPoint<orthographic> projected(const Point& p) {
  return projected<orthographic>(p, inverse(w_of<orthographic>(p.depth)));
}

// The side of the picture on which a point can be the extreme.
enum class Side { left, right, either };

// The two points added so far that extend farthest left and right: anywhere, or within one tile plane.
template <bool orthographic, bool in_tile_plane>
struct ExtremesOf {
  using Projected = ProjectedPoint<orthographic>;
  Projected low, high;

  HWY_INLINE explicit ExtremesOf(V up = Zero(D()))
      : low{all(k_none), up, all(1.0f)}, high{all(-k_none), up, all(1.0f)} {}

  HWY_INLINE void add(M where, const Projected& p, Side side = Side::either) {
    if (side != Side::right) set_if(And(where, p.across < low.across), p, low);
    if (side != Side::left) set_if(And(where, p.across > high.across), p, high);
  }
  HWY_INLINE M exist() const { return low.across < all(k_none); }

  // The result moved one lane on, for another tile plane.
  HWY_INLINE ExtremesOf carried(const Carried& carry, ExtremesOf& turned, V up) const {
    ExtremesOf next(up);
    next.low.across = carry(low.across, turned.low.across);
    next.low.depth = carry(low.depth, turned.low.depth);
    next.high.across = carry(high.across, turned.high.across);
    next.high.depth = carry(high.depth, turned.high.depth);
    return next;
  }

 private:
  static constexpr float k_none = 1e15f;

  static HWY_INLINE void set_if(M where, const Projected& p, Projected& extreme) {
    extreme.across = IfThenElse(where, p.across, extreme.across);
    if constexpr (!in_tile_plane) extreme.up = IfThenElse(where, p.up, extreme.up);
    extreme.depth = IfThenElse(where, p.depth, extreme.depth);
  }
};
template <bool orthographic>
using Extremes = ExtremesOf<orthographic, false>;
template <bool orthographic>
using PlaneExtremes = ExtremesOf<orthographic, true>;

// Spots and the values that follow from them alone. Points outside by less than the slack count as inside.
struct SpotShapes {
  Cone cone;
  V slack;
  Point m1, m2;           // unit vectors across the axis; not set for spots that Slices::Lookup returns
  Point rim, rim1, rim2;  // the middle of the rim, and vectors from it to two of its points
  V least_along;          // least coordinate along the axis of points of the sphere that are in the cone

  SpotShapes() = default;
  HWY_INLINE SpotShapes(const Cone& of_cone, V of_slack) : cone(of_cone), slack(of_slack) {
    const Point any = chosen(Abs(cone.axis.x) < all(0.7f), x_axis(), y_axis());
    const Point across = any - dot(any, cone.axis) * cone.axis;
    m1 = inverse(length(across)) * across;
    m2 = cross(cone.axis, m1);
    const V forth = cone.range * cone.cosine, out = cone.range * cone.sine;
    rim = cone.apex + forth * cone.axis;
    rim1 = out * m1;
    rim2 = out * m2;
    least_along = forth - slack * cone.sine;
  }

  // Is a point of the sphere, at `along` on the axis from the apex, in the cone?
  HWY_INLINE M is_in_cone(V along) const { return along >= least_along; }
  HWY_INLINE M is_sphere_in_cone(const Point& p) const { return is_in_cone(dot(p - cone.apex, cone.axis)); }

  // Visits the points of the rim with a cos phi + b sin phi = c.
  template <class Visit>
  HWY_INLINE void each_rim_point(V a, V b, V c, Visit&& visit) const {
    each_angle(a, b, c, [&](M exist, V cosine, V sine) { visit(exist, rim + cosine * rim1 + sine * rim2); });
  }

  // The generators in which planes through the apex that contain a direction touch the cone; NaN where there are none.
  HWY_INLINE void find_generators(const Point& direction, Point (&generators)[2]) const {
    const V steepness = cone.sine / Max(cone.cosine, all(1e-6f));
    Point* next = generators;
    each_angle(dot(direction, m1), dot(direction, m2), steepness * dot(direction, cone.axis),
               [&](M, V cosine, V sine) { *next++ = cone.cosine * cone.axis + cone.sine * (cosine * m1 + sine * m2); });
  }
  // Is the distance t from the apex on a generator?
  HWY_INLINE M is_on_generator(V t) const { return is_between(Zero(D()), t, cone.range + slack); }

  // The points of the sphere farthest to the left and to the right, at `up` and `ahead` from the apex. Calls visit(mask
  // where they exist, x, side).
  template <class Visit>
  HWY_INLINE void each_sphere_point(V up, V ahead, Visit&& visit) const {
    const V square = square_of(cone.range) - (square_of(up) + square_of(ahead)), half = root(square);
    const V middle = up * cone.axis.y + ahead * cone.axis.depth;
    const M exist = square >= Zero(D());
    const auto visit_at = [&](V across, Side side) {
      visit(And(exist, is_in_cone(middle + across * cone.axis.x)), cone.apex.x + across, side);
    };
    visit_at(Neg(half), Side::left);
    visit_at(half, Side::right);
  }
};

// Two planes across the view axis: their depths and 1 / w there.
struct SlicePlanes {
  V near, far, inverse_near, inverse_far;

  HWY_INLINE M contain(V depth, V slack) const { return is_between(near - slack, depth, far + slack); }
  template <bool orthographic>
  HWY_INLINE V farthest() const {
    return orthographic ? Max(Abs(near), Abs(far)) : far;  // in perspective all depths are in front
  }
};

// Calls visit(mask, point, side) for each point where spots between two slice planes can extend farthest across, at any
// height. First the points that can be the extreme of one side only, left and right in turn.
inline constexpr int k_one_sided_points = 6, k_points_in_slice = 17;
template <bool orthographic, class Visit>
HWY_INLINE void each_point_in_slice(const SpotShapes& spots, const SlicePlanes& planes, Visit&& visit) {
  const Point& a = spots.cone.apex;
  const V zero = Zero(D());

  // The points where the sphere extends farthest at the apex's height.
  const auto visit_tangent = [&](M exists, const Point& p, Side side) {
    const M is_in = And(planes.contain(p.depth, spots.slack), spots.is_sphere_in_cone(p));
    visit(And(exists, is_in), projected<orthographic>(p), side);
  };
  const M always = zero == zero;
  if constexpr (orthographic) {
    visit_tangent(always, {a.x - spots.cone.range, a.y, a.depth}, Side::left);
    visit_tangent(always, {a.x + spots.cone.range, a.y, a.depth}, Side::right);
  } else {
    const V range_square = square_of(spots.cone.range), square = square_of(a.x) + square_of(a.depth);
    const V tangent_square = square - range_square, scale = inverse(square);
    const V turn = scale * root(range_square * tangent_square), shrink = scale * tangent_square;
    const auto tangent = [&](V turned) {
      return Point{shrink * a.x - turned * a.depth, a.y, shrink * a.depth + turned * a.x};
    };
    visit_tangent(tangent_square > zero, tangent(turn), Side::left);
    visit_tangent(tangent_square > zero, tangent(Neg(turn)), Side::right);
  }

  // In the slice planes: the sphere, the rim, and the cone's side where upright planes touch it.
  struct Plane {
    V depth, inverse_w;
  };
  const Plane in_planes[2] = {{planes.near, planes.inverse_near}, {planes.far, planes.inverse_far}};
  for (const Plane& plane : in_planes)
    spots.each_sphere_point(zero, plane.depth - a.depth, [&](M exists, V x, Side side) {
      visit(exists, projected<orthographic>({x, a.y, plane.depth}, plane.inverse_w), side);
    });
  Point generators[2];
  spots.find_generators(y_axis(), generators);
  for (const Plane& plane : in_planes) {
    const auto visit_at = [&](M where, V x, V y) {
      visit(where, projected<orthographic>({x, y, plane.depth}, plane.inverse_w), Side::either);
    };
    spots.each_rim_point(spots.rim1.depth, spots.rim2.depth, plane.depth - spots.rim.depth,
                         [&](M exists, const Point& p) { visit_at(exists, p.x, p.y); });
    for (const Point& g : {generators[0], generators[1]}) {
      const V t = (plane.depth - a.depth) / g.depth;
      visit_at(spots.is_on_generator(t), a.x + t * g.x, a.y + t * g.y);
    }
  }

  // The rim's tangents, and the apex.
  const auto visit_in_slice = [&](M where, const Point& p) {
    visit(And(where, planes.contain(p.depth, spots.slack)), projected<orthographic>(p), Side::either);
  };
  const Point &rim = spots.rim, &rim1 = spots.rim1, &rim2 = spots.rim2;
  const V w = w_of<orthographic>(rim.depth);
  const V w1 = w_along<orthographic>(rim1.depth), w2 = w_along<orthographic>(rim2.depth);
  spots.each_rim_point(rim2.x * w - rim.x * w2, rim.x * w1 - rim1.x * w, rim1.x * w2 - rim2.x * w1, visit_in_slice);
  visit_in_slice(always, a);
}

// Spots, each in a slice, with the values that all of its tile planes share.
template <bool orthographic>
struct SpotsInSlices {
  SpotShapes shapes;
  SlicePlanes between;
  V light;              // size of the numbers that describe the spot
  V tangent;            // distance from the eye to the touch points of the sphere's tangents; in perspective
  Point generators[2];  // where planes through the eye, or along the view axis, touch the cone
  V inverse_form;       // 1 / (axis.x² - cosine²)

  SpotsInSlices() = default;
  HWY_INLINE SpotsInSlices(const SpotShapes& of_shapes, const SlicePlanes& of_between, V of_light)
      : shapes(of_shapes), between(of_between), light(of_light) {
    const Cone& cone = shapes.cone;
    tangent = root(dot(cone.apex, cone.apex) - square_of(cone.range));
    shapes.find_generators(orthographic ? depth_axis() : cone.apex, generators);
    inverse_form = inverse(square_of(cone.axis.x) - square_of(cone.cosine));
  }

  // Visits all vectors of the struct, always in the same order. m1 and m2 are not needed after this.
  template <class Visit>
  HWY_INLINE void each(Visit&& visit) {
    const auto visit_point = [&](Point& p) {
      visit(p.x);
      visit(p.y);
      visit(p.depth);
    };
    for (Point* p : {&shapes.cone.apex, &shapes.cone.axis, &shapes.rim, &shapes.rim1, &shapes.rim2, &generators[0],
                     &generators[1]})
      visit_point(*p);
    for (V* v :
         {&shapes.cone.range, &shapes.cone.cosine, &shapes.cone.sine, &shapes.slack, &shapes.least_along, &between.near,
          &between.far, &between.inverse_near, &between.inverse_far, &light, &tangent, &inverse_form})
      visit(*v);
  }
  static constexpr int k_vectors = 33;

  // The extremes of the spots in a tile plane, y = slope * w.
  HWY_INLINE PlaneExtremes<orthographic> in_tile_plane(V slope) const {
    PlaneExtremes<orthographic> found(slope);
    add_tangents(slope, found);
    add_rim(slope, found);
    add_generators(slope, found);
    add_edge(slope, between.near, between.inverse_near, found);
    add_edge(slope, between.far, between.inverse_far, found);
    return found;
  }

 private:
  HWY_INLINE void add_tangents(V slope, PlaneExtremes<orthographic>& found) const {
    using Projected = ProjectedPoint<orthographic>;
    const Point& a = shapes.cone.apex;
    const V range = shapes.cone.range, zero = Zero(D());
    const auto add_both = [&](M exist, const Projected& low, const Projected& high) {
      const auto is_in = [&](const Projected& p) {
        return And(exist, And(between.contain(p.depth, shapes.slack), shapes.is_sphere_in_cone(p.point())));
      };
      found.add(is_in(low), low, Side::left);
      found.add(is_in(high), high, Side::right);
    };
    const V tilt = orthographic ? all(1.0f) : Sqrt(all(1.0f) + square_of(slope)), inverse_tilt = inverse(tilt);
    const V away = (a.y - slope * w_of<orthographic>(a.depth)) * inverse_tilt;
    const V rho_square = (range - away) * (range + away), rho = root(rho_square);
    if constexpr (orthographic) {
      add_both(rho_square >= zero, {a.x - rho, slope, a.depth}, {a.x + rho, slope, a.depth});
    } else {
      const V ahead = (slope * a.y + a.depth) * inverse_tilt;
      const V shrink = tangent * inverse(square_of(a.x) + square_of(ahead));
      const V b = ahead * tangent, c = a.x * rho, d = a.x * tangent, e = ahead * rho;
      const V low_lean = b + c, high_lean = b - c, both = inverse(low_lean * high_lean);
      const V to_depth = shrink * inverse_tilt;
      add_both(And(rho_square >= zero, tangent > zero),
               {tilt * ((d - e) * high_lean * both), slope, to_depth * low_lean},
               {tilt * ((d + e) * low_lean * both), slope, to_depth * high_lean});
    }
  }

  HWY_INLINE void add_rim(V slope, PlaneExtremes<orthographic>& found) const {
    const auto along = [&](const Point& way) { return way.y - slope * w_along<orthographic>(way.depth); };
    const V below = slope * w_of<orthographic>(shapes.rim.depth) - shapes.rim.y;
    shapes.each_rim_point(along(shapes.rim1), along(shapes.rim2), below,
                          [&](M exists, const Point& p) { add_in_slice(exists, p.x, slope, p.depth, found); });
  }

  // Where planes through the eye touch the cone's side.
  HWY_INLINE void add_generators(V slope, PlaneExtremes<orthographic>& found) const {
    const Point& a = shapes.cone.apex;
    const V above = slope * w_of<orthographic>(a.depth) - a.y;
    for (const Point& g : {generators[0], generators[1]}) {
      const V t = above / (g.y - slope * w_along<orthographic>(g.depth));
      add_in_slice(shapes.is_on_generator(t), a.x + t * g.x, slope, a.depth + t * g.depth, found);
    }
  }
  HWY_INLINE void add_in_slice(M exists, V x, V slope, V depth, PlaneExtremes<orthographic>& found) const {
    found.add(And(exists, between.contain(depth, shapes.slack)), {x / w_of<orthographic>(depth), slope, depth});
  }

  // Where the sphere and the cone's side meet a slice plane: along² = cosine² (x² + rest), along = x axis.x + k.
  HWY_INLINE void add_edge(V slope, V depth, V inverse_w, PlaneExtremes<orthographic>& found) const {
    const Cone& cone = shapes.cone;
    const V up = slope * w_of<orthographic>(depth) - cone.apex.y, ahead = depth - cone.apex.depth;
    const auto add_at = [&](M where, V x, Side side) { found.add(where, {x * inverse_w, slope, depth}, side); };
    shapes.each_sphere_point(up, ahead, add_at);
    const V rest = square_of(up) + square_of(ahead);
    const V k = up * cone.axis.y + ahead * cone.axis.depth, cosine_square = square_of(cone.cosine);
    const V qa = square_of(cone.axis.x) - cosine_square, qb = k * cone.axis.x;
    const V qc = square_of(k) - cosine_square * rest;
    // qb² - qa qc, without its cancellation for wide cones.
    const V inside = square_of(k) + qa * rest, longest_square = square_of(cone.range + shapes.slack);
    const M exist = inside >= Zero(D());
    const V q = Neg(qb + CopySign(cone.cosine * root(inside), qb));
    for (const V x : {q * inverse_form, qc / q}) {
      const M is_in = And(x * cone.axis.x + k >= Neg(shapes.slack), square_of(x) + rest <= longest_square);
      add_at(And(exist, is_in), cone.apex.x + x, Side::either);
    }
  }
};

}  // namespace clusterbench::assign::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
