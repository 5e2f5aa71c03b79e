// A vector of cells, each with its own spot, and what may settle whether they share a point. For files that are
// compiled once per target; included after hwy/highway.h; defines its names anew for each target.

#if defined(CLUSTERBENCH_SPOT_CELLS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLUSTERBENCH_SPOT_CELLS_INL_H
#undef CLUSTERBENCH_SPOT_CELLS_INL_H
#else
#define CLUSTERBENCH_SPOT_CELLS_INL_H
#endif

#include "assign/cone/spot_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {

// A vector of cells, each with its own cone. In perspective sides and rows are slopes, else coordinates.
template <bool k_perspective>
class CellsOf {
 public:
  // Those between two sides of columns.
  HWY_INLINE CellsOf(const SpotsInRows& rows, V left, V right)
      : cone_(rows.cone),
        left_(left),
        right_(right),
        y0_(rows.y0),
        y1_(rows.y1),
        depth0_(rows.depth0),
        depth1_(rows.depth1),
        tolerance_(k_perspective ? rows.tolerance(left, right) : rows.parallel_tolerance(left, right)),
        safe_range_(cone_.range - tolerance_) {
    for (unsigned i = 0; i < 8; ++i) from_apex_[i] = corner(i) - cone_.apex;
  }

  // A corner well inside.
  HWY_INLINE M holds_corner() const {
    M any = Not(yes());
    for (const Point& v : from_apex_) any = Or(any, is_inside(v));
    return any;
  }

  // A face between, or a plane along the cone's side towards the cell's middle.
  HWY_INLINE M is_apart() const {
    M apart = is_beside(sum_of_corners());
    each_face([&](const Point& normal, V offset) {
      const V scale = all(1.0f) / face_length(normal);
      const V beyond = scale * (dot(normal, cone_.apex) - offset);
      apart = Or(apart, beyond - extent(Neg(scale) * normal) > tolerance_);
    });
    return apart;
  }

  // From the cell to the volume and back a few times, both smaller by a little more than the tolerance. Where they
  // share room, both soon hold the same point; where they do not, the way from one to the other crosses a plane
  // between.
  HWY_INLINE void approach(M& common, M& apart) const {
    constexpr int k_ways = 3;
    Point in_cell = all(0.125f) * sum_of_corners();
    for (int way = 0; way < k_ways; ++way) in_cell = closer_to_volume(in_cell);
    const Point in_volume = nearest_in_volume(in_cell);
    common = Or(is_common(in_cell), is_common(in_volume));
    apart = is_past(in_cell - in_volume);
  }

  // Places on the edges: nearest to the axis as an angle, nearest to the apex, and between these.
  HWY_INLINE M holds_edge_point() const {
    M any = Not(yes());
    each_edge([&](const Point& start, const Point& step) {
      const V start_axis = dot(start, cone_.axis), step_axis = dot(step, cone_.axis), mixed = dot(start, step);
      const V start_square = dot(start, start), step_square = dot(step, step);
      const V above = step_axis * start_square - start_axis * mixed;
      const V below = start_axis * step_square - step_axis * mixed;
      const auto within = [](V t) { return Clamp(t, Zero(D()), all(1.0f)); };
      const V to_axis = within(above / below), to_apex = within(Neg(mixed) / step_square);
      for (const V t : {to_axis, to_apex, all(0.5f) * (to_axis + to_apex)}) any = Or(any, is_inside(start + t * step));
    });
    return any;
  }

  // The mean of all points where cell ∩ volume can be extreme (geom/search/extreme_candidates.h), which lies inside of
  // it; and planes along the cone's side that are equally far from both ends of an edge. The nearest such point tells
  // more of them.
  HWY_INLINE void settle(M& common, M& apart) const {
    const V zero = Zero(D());
    Extremes extremes{{zero, zero, zero}, zero, {zero, zero, zero}, all(k_none)};
    for (const Point& v : from_apex_) take(is_in_cone(v), v, extremes);
    each_edge([&](const Point& start, const Point& step) { take_edge(start, step, extremes); });
    each_face([&](const Point& outward, V offset) {
      const V scale = all(1.0f) / face_length(outward);
      take_face(scale * outward, scale * (offset - dot(outward, cone_.apex)), extremes);
    });
    take_in_cell(cone_.range * cone_.axis, yes(), extremes);
    common = is_common((all(1.0f) / Max(extremes.count, all(1.0f))) * extremes.sum);
    apart = Or(is_beside_edges(), is_beyond(extremes));
  }

  // From a point of the cell to the volume and back, a little too far.
  HWY_INLINE Point closer_to_volume(const Point& v) const {
    return near_in_cell(v + all(1.5f) * (nearest_in_volume(v) - v));
  }

  // A point of the cell made smaller by a little more than the tolerance: not the nearest one where its sides lean, but
  // one nearby.
  HWY_INLINE Point near_in_cell(const Point& v) const {
    const V within = all(k_within) * tolerance_;
    const Point point = v + cone_.apex;
    const V depth = Clamp(point.depth, depth0_ + within, depth1_ - within);
    const auto inset = [&](V slope) { return k_perspective ? within * (all(1.0f) + Abs(slope)) : within; };
    const auto between = [&](V low, V at, V high) {
      return Clamp(at, at_depth(low, depth) + inset(low), at_depth(high, depth) - inset(high));
    };
    return Point{between(left_, point.x, right_), between(y0_, point.y, y1_), depth} - cone_.apex;
  }

  // Evidence.

  // Is the point v from the apex in volume and cell, by more than the tolerance?
  HWY_INLINE M is_common(const Point& v) const { return And(is_inside(v), is_in_cell(v, tolerance_)); }

  // Outwards, of the plane along the cone's side in a direction across the axis.
  HWY_INLINE Point side_normal(const Point& across) const {
    return (cone_.cosine / length(across)) * across - cone_.sine * cone_.axis;
  }

  // Do all corners lie beyond the plane along the cone's side in the direction of v?
  HWY_INLINE M is_beside(const Point& v) const {
    const Point part = v - dot(v, cone_.axis) * cone_.axis;
    // Where v is nearly along the axis, what is across it has few digits. Elsewhere up to 65 u of it are still along
    // the axis; once more leaves 6 u.
    const M is_good = dot(part, part) > all(0.01f) * dot(v, v);
    const Point across = part - dot(part, cone_.axis) * cone_.axis;
    return And(is_good, least_along(side_normal(across)) > tolerance_);
  }

  // Do all corners lie farther in a direction than the volume extends?
  HWY_INLINE M is_past(const Point& direction) const {
    const Point normal = (all(1.0f) / length(direction)) * direction;
    return least_along(normal) - extent(normal) > tolerance_;
  }

 private:
  static constexpr float k_none = 1e30f;
  static constexpr float k_within = 1.25f;  // of the tolerance
  // Places that lie in cell and volume, by and large: their sum, and the one nearest to the apex of those that lie in
  // cell and endless cone.
  struct Extremes {
    Point sum;
    V count;
    Point nearest;
    V least;  // its square distance; k_none without one
  };

  HWY_INLINE static M yes() { return Zero(D()) == Zero(D()); }

  HWY_INLINE Point sum_of_corners() const {
    Point sum = from_apex_[0];
    for (unsigned i = 1; i < 8; ++i) sum = sum + from_apex_[i];
    return sum;
  }

  // Of the smaller volume: its apex moved along the axis, its range shorter.
  HWY_INLINE Point nearest_in_volume(const Point& v) const {
    const V zero = Zero(D()), tiny = all(1e-30f);
    const V within = all(k_within) * tolerance_;
    const V ahead = Min(within / Max(cone_.sine, tiny), all(0.5f) * cone_.range);
    const V along = dot(v, cone_.axis) - ahead;
    const Point offset = v - (along + ahead) * cone_.axis;
    const V across = length(offset);
    const M is_in = cone_.sine * along >= cone_.cosine * across;
    const V t = Max(zero, along * cone_.cosine + across * cone_.sine);
    const V to_along = IfThenElse(is_in, along, t * cone_.cosine);
    const V narrowed = t * cone_.sine / Max(across, tiny);
    const Point to = (to_along + ahead) * cone_.axis + IfThenElse(is_in, all(1.0f), narrowed) * offset;
    const V range = cone_.range - within;
    return Min(all(1.0f), range / Max(length(to), tiny)) * to;
  }

  // By and large: the tolerance is on their side.
  HWY_INLINE M is_in_cone(const Point& v) const {
    const V along = dot(v, cone_.axis), across = length(v - along * cone_.axis);
    return cone_.sine * along - cone_.cosine * across >= Neg(tolerance_);
  }
  HWY_INLINE M is_in_range(const Point& v) const {
    const V range = cone_.range + tolerance_;
    return dot(v, v) <= range * range;
  }
  // By more than this much.
  HWY_INLINE M is_in_cell(const Point& v, V margin) const {
    M is_in = yes();
    each_face([&](const Point& outward, V offset) {
      is_in = And(is_in, offset - dot(outward, cone_.apex + v) > margin * face_length(outward));
    });
    return is_in;
  }

  // `where` it lies in cell and endless cone.
  HWY_INLINE void take(M where, const Point& v, Extremes& extremes) const {
    const M counts = And(where, is_in_range(v));
    const V one = IfThenElseZero(counts, all(1.0f)), square = dot(v, v);
    const M is_nearer = And(where, square < extremes.least);
    extremes.sum = chosen(counts, extremes.sum + v, extremes.sum);
    extremes.count = extremes.count + one;
    extremes.least = IfThenElse(is_nearer, square, extremes.least);
    extremes.nearest = chosen(is_nearer, v, extremes.nearest);
  }
  // A point of the volume's surface, if it is in the cell.
  HWY_INLINE void take_in_cell(const Point& v, M where, Extremes& extremes) const {
    take(And(where, is_in_cell(v, Neg(tolerance_ + tolerance_))), v, extremes);
  }

  // Where it is nearest to the apex, and where it meets the cone's side and the sphere.
  HWY_INLINE void take_edge(const Point& start, const Point& step, Extremes& extremes) const {
    const auto take_at = [&](M exists, V t) {
      const M is_on = And(exists, And(t >= Zero(D()), t <= all(1.0f)));
      const Point v = start + t * step;
      take(And(is_on, is_in_cone(v)), v, extremes);
    };
    const auto take_roots = [&](V a, V b, V c) {  // of a t² + 2 b t + c
      const V square = b * b - a * c;
      const M exist = square >= Zero(D());
      const V q = Neg(b + CopySign(Sqrt(Max(square, Zero(D()))), b));
      take_at(exist, q / a);
      take_at(exist, c / q);
    };
    const V start_square = dot(start, start), mixed = dot(start, step), step_square = dot(step, step);
    take_at(yes(), Neg(mixed / step_square));
    take_roots(step_square, mixed, start_square - cone_.range * cone_.range);
    // sin² along² = cos² across².
    const V start_along = dot(start, cone_.axis), step_along = dot(step, cone_.axis);
    const Point start_across = start - start_along * cone_.axis, step_across = step - step_along * cone_.axis;
    const auto form = [&](V along1, V along2, const Point& across1, const Point& across2) {
      const V s2 = cone_.sine * cone_.sine, c2 = cone_.cosine * cone_.cosine;
      return s2 * (along1 * along2) - c2 * dot(across1, across2);
    };
    take_roots(form(step_along, step_along, step_across, step_across),
               form(start_along, step_along, start_across, step_across),
               form(start_along, start_along, start_across, start_across));
  }

  // Unit normal; margin: how far the apex is on the inner side. The foot of the apex, the sphere's deepest point,
  // the generators in the plane of axis and normal: where they meet the face, and their ends; and two points on the
  // rim.
  HWY_INLINE void take_face(const Point& outward, V margin, Extremes& extremes) const {
    const Point foot = margin * outward, deepest = Neg(cone_.range) * outward;
    take_in_cell(foot, is_in_cone(foot), extremes);
    take_in_cell(deepest, is_in_cone(deepest), extremes);
    const Point across = unit_across(outward);
    for (const V side : {cone_.sine, Neg(cone_.sine)}) {
      const Point generator = cone_.cosine * cone_.axis + side * across;
      const V t = margin / dot(outward, generator);
      take_in_cell(t * generator, t > Zero(D()), extremes);
      take_in_cell(cone_.range * generator, yes(), extremes);
    }
    // The face on the rim, where side and sphere meet.
    const V rim_along = cone_.range * cone_.cosine, rim_across = cone_.range * cone_.sine;
    const V reach = rim_across * dot(outward, across);
    const V cosine = (margin - rim_along * dot(outward, cone_.axis)) / reach;
    const V square = all(1.0f) - cosine * cosine;
    const M meets = square >= Zero(D());
    const V sine = Sqrt(Max(square, Zero(D())));
    const Point middle = rim_along * cone_.axis + (rim_across * cosine) * across;
    const Point offset = (rim_across * sine) * cross(cone_.axis, across);
    take_in_cell(middle + offset, meets, extremes);
    take_in_cell(middle - offset, meets, extremes);
  }

  // A unit vector across the axis, towards v where v is not nearly along the axis.
  HWY_INLINE Point unit_across(const Point& v) const {
    const M is_good = length(cross(v, cone_.axis)) > all(0.1f) * length(v);
    return chosen(is_good, direction_across(cone_.axis, v), any_across(cone_.axis));
  }

  // Is there a plane along the cone's side, equally far from both ends of an edge, beyond which all corners lie?
  HWY_INLINE M is_beside_edges() const {
    const Point m = any_across(cone_.axis), m2 = cross(cone_.axis, m);
    M apart = Not(yes());
    each_edge([&](const Point&, const Point& edge) {
      // Not times the cosine, whose square would not be a number that single precision has where the angle is nearly 90
      // degrees.
      const V along = cone_.sine * dot(edge, cone_.axis) / cone_.cosine;
      each_angle(dot(edge, m), dot(edge, m2), along, [&](M exist, V to_m, V to_m2) {
        apart = Or(apart, And(exist, least_along(side_normal(to_m * m + to_m2 * m2)) > tolerance_));
      });
    });
    return apart;
  }

  // Where cell and endless cone meet beyond the range only: is there a plane through the nearest point, between the
  // sphere's tangent there and the cone's side, that an edge says how to lean?
  HWY_INLINE M is_beyond(const Extremes& extremes) const {
    const Point generator = (all(1.0f) / Sqrt(extremes.least)) * extremes.nearest;
    const Point outward = cone_.cosine * unit_across(generator) - cone_.sine * cone_.axis;
    M apart = is_past(generator);
    each_edge([&](const Point&, const Point& edge) {
      const V share = Neg(dot(generator, edge) / dot(outward, edge));
      apart = Or(apart, And(share > Zero(D()), is_past(generator + share * outward)));
    });
    return And(apart, extremes.least < all(k_none));
  }

  // The coordinate that a side or a row has there.
  static HWY_INLINE V at_depth(V side, V depth) {
    if constexpr (!k_perspective) return side;
    return side * depth;
  }
  HWY_INLINE Point corner(unsigned i) const {
    const V depth = (i & 4) != 0 ? depth1_ : depth0_;
    return {at_depth((i & 1) != 0 ? right_ : left_, depth), at_depth((i & 2) != 0 ? y1_ : y0_, depth), depth};
  }
  // From where an edge starts to its end.
  template <class Take>
  HWY_INLINE void each_edge(Take&& take) const {
    for (unsigned corner = 0; corner < 8; ++corner)
      for (const unsigned bit : {1u, 2u, 4u})
        if ((corner & bit) == 0) take(from_apex_[corner], from_apex_[corner | bit] - from_apex_[corner]);
  }

  // Outward normals (any length) and the faces along them.
  template <class Take>
  HWY_INLINE void each_face(Take&& take) const {
    if constexpr (k_perspective) {
      const V zero = Zero(D()), plus = all(1.0f), minus = all(-1.0f);
      take(Point{minus, zero, left_}, zero);
      take(Point{plus, zero, Neg(right_)}, zero);
      take(Point{zero, minus, y0_}, zero);
      take(Point{zero, plus, Neg(y1_)}, zero);
    } else {
      take(x_axis(-1.0f), Neg(left_));
      take(x_axis(), right_);
      take(y_axis(-1.0f), Neg(y0_));
      take(y_axis(), y1_);
    }
    take(depth_axis(-1.0f), Neg(depth0_));
    take(depth_axis(), depth1_);
  }

  // Of a face's normal.
  static HWY_INLINE V face_length(const Point& outward) {
    if constexpr (!k_perspective) return all(1.0f);
    return length(outward);
  }

  // The least of the corners along a direction.
  HWY_INLINE V least_along(const Point& direction) const {
    V least = dot(direction, from_apex_[0]);
    for (unsigned i = 1; i < 8; ++i) least = Min(least, dot(direction, from_apex_[i]));
    return least;
  }

  // Is the point v from the apex in the volume, by more than the tolerance?
  HWY_INLINE M is_inside(const Point& v) const {
    const V zero = Zero(D()), along = dot(v, cone_.axis);
    const Point offset = v - along * cone_.axis;
    // Squares, because roots are slow. They add a few u to what the tolerance is for.
    const V side = cone_.sine * along - tolerance_;
    const M is_in_cone = And(side > zero, side * side > cone_.cosine * cone_.cosine * dot(offset, offset));
    return And(is_in_cone, And(safe_range_ > zero, dot(v, v) < safe_range_ * safe_range_));
  }

  // How far the volume extends from its apex along a unit vector.
  HWY_INLINE V extent(const Point& normal) const { return extent_of(cone_, normal, all(1.0f)); }

  Cone cone_;
  V left_, right_, y0_, y1_, depth0_, depth1_, tolerance_, safe_range_;
  Point from_apex_[8];
};
using Cells = CellsOf<true>;

}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
HWY_AFTER_NAMESPACE();

#endif
