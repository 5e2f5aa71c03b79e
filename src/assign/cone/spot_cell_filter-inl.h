// The tests of the filter (spot_cell_filter.h): a vector of cells, each against its own spot. For files that are
// compiled once per target.

#if defined(CLUSTERBENCH_SPOT_CELL_FILTER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLUSTERBENCH_SPOT_CELL_FILTER_INL_H
#undef CLUSTERBENCH_SPOT_CELL_FILTER_INL_H
#else
#define CLUSTERBENCH_SPOT_CELL_FILTER_INL_H
#endif

#include "assign/cone/spot_cell_filter.h"
#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign::HWY_NAMESPACE {

// The w of clip space, by which a point is divided to be projected: its depth; without perspective 1. A slope is x / w
// or y / w. w_along is the change of w for a change of depth.
template <bool orthographic>
HWY_INLINE V w_of(V depth) {
  return orthographic ? all(1.0f) : depth;
}
template <bool orthographic>
HWY_INLINE V w_along(V depth) {
  return orthographic ? Zero(D()) : depth;
}

struct Cone {
  Point apex, axis;
  V range, cosine, sine;
};

// Evidence is a point inside cell and volume, or a plane between them, with a margin above the tolerance 2^-19 S = 32 u
// S; u = 2^-24, S = |apex| + 2 range + the cell's largest coordinates. A point counts as exactly apex + v. A plane
// counts with the normal as computed, of length 1 to 5 u; for a normal of another length all margins and the tolerance
// scale with that length. How a candidate was found does not matter, only the error of its measured margin. Given
// numbers are off by u of themselves: range, sine, cosine and each coordinate of apex and axis. Sums and products of
// three lose 3 u of the vectors' lengths, a length 3 u. Then margins are off by at most
//    9 u S  of a point in the sphere: 5 u range, u |apex|; in the cone: along the axis 4 u range + u |apex|, across it
//           3 u range + u |apex|, both times sine and cosine, squared and compared 5 u range
//    6 u S  of a point in the cell: apex + v is rounded, 2 u of a product and a sum
//    5 u S  of corners along a normal: u of a corner, u of it from the apex, 3 u of the product
//   10 u S  of how far the volume extends along a normal: along the axis 6 u range, across it 11 u range, 3 u for the
//   rest
//    7 u S  of a plane along the cone's side, whose extent is taken to be 0: its direction across the axis is at right
//           angles to it to 6 u, of length 1 to 5 u, and 3 u for the rest, times range
//   10 u S  of the apex from a face: 5 u for the product and the offset, 5 u for the length of the normal
// so under 20 u S for a plane. Example: a spot of 10 m, 50 m from the eye, and a cell up to 45 m deep, 35 m to the
// side, 10 m up: S = 160 m, the tolerance is 0.3 mm, and the measuring error is below 0.2 mm.
constexpr float k_tolerance = 0x1p-19f;

// The least margin that counts as evidence. `light`: the size of the numbers that describe the spot. The cells reach to
// `depth` and to the slopes `across` and `up` (without perspective these are coordinates; then corners and normals are
// exact).
template <bool orthographic>
HWY_INLINE V tolerance_of(V light, V depth, V across, V up) {
  const V sideways = across + up;
  return all(k_tolerance) * (light + (orthographic ? depth + sideways : depth * (all(1.0f) + sideways)));
}

// The extent of a volume from its apex along a normal of length `size`. The part across the axis is computed as a
// vector: a root of 1 - cosine² would lose half the digits.
HWY_INLINE V extent_of(const Cone& cone, const Point& normal, V size) {
  const V along = dot(normal, cone.axis), across = length(normal - along * cone.axis);
  const M is_in_cone = cone.sine * along >= cone.cosine * across;
  const V lean = Max(Zero(D()), along * cone.cosine + across * cone.sine);
  return cone.range * IfThenElse(is_in_cone, size, lean);
}

// A vector of spots.
struct GivenSpots {
  Cone cone;
  V light;  // size of the numbers that describe the spot

  HWY_INLINE GivenSpots(const view::LightArrays& lights, VI spot) {
    // Gathering takes longer than many of the following steps, and with few spots a vector often holds only one.
    const std::int32_t first = GetLane(spot);
    if (AllTrue(DI(), spot == all(first)))
      load(lights, [&](const float* from) { return all(from[first]); });
    else
      load(lights, [&](const float* from) { return gathered(from, spot); });
  }

 private:
  template <class Get>
  HWY_INLINE void load(const view::LightArrays& lights, Get&& get) {
    const std::uint32_t points = lights.spots.first;
    cone = {{get(lights.x.data() + points), get(lights.y.data() + points), Neg(get(lights.z.data() + points))},
            {get(lights.axis_x.data()), get(lights.axis_y.data()), Neg(get(lights.axis_z.data()))},
            get(lights.radius.data() + points),
            get(lights.cos_angle.data()),
            get(lights.sin_angle.data())};
    light = get(lights.reach.data() + points) + cone.range;
  }
};

// The spots whose size single precision can handle.
HWY_INLINE M fit_single_precision(const RowPlanes& planes, V light) {
  return is_between(all(planes.least_reach), light, all(k_most_row_reach));
}

// Spots, each with its own row of cells: tile planes below and above, slice planes in front and behind.
struct SpotsInRows {
  Cone cone;
  V light;  // GivenSpots::light
  V y0, y1, depth0, depth1;

  // The tolerance for the columns between two sides.
  template <bool orthographic>
  HWY_INLINE V tolerance(V left, V right) const {
    const V depth = orthographic ? Max(Abs(depth0), Abs(depth1)) : depth1;
    return tolerance_of<orthographic>(light, depth, Max(Abs(left), Abs(right)), Max(Abs(y0), Abs(y1)));
  }
};

// The indices of a list from `first` on.
HWY_INLINE VI loaded_indices(const std::vector<std::uint32_t>& list, std::uint32_t first) {
  return BitCast(DI(), LoadU(DU(), list.data() + first));
}

// A vector of cells, each with its own cone. Sides and rows are slopes; without perspective they are coordinates.
template <bool orthographic>
class CellTests {
 public:
  // The cells between two sides of columns.
  HWY_INLINE CellTests(const SpotsInRows& rows, V left, V right)
      : rows_(rows),
        cone_(rows.cone),
        left_(left),
        right_(right),
        tolerance_(rows.tolerance<orthographic>(left, right)),
        safe_range_(cone_.range - tolerance_) {
    for (unsigned i = 0; i < 8; ++i) from_apex_[i] = corner(i) - cone_.apex;
  }

  // Filter, yes: is a corner of the cell inside the volume by more than the tolerance?
  HWY_INLINE M has_corner_in_volume() const {
    M any = Not(yes());
    for (const Point& v : from_apex_) any = Or(any, is_inside(v));
    return any;
  }

  // Filter, no: is a face of the cell, or the plane along the cone's side towards the cell's middle, between cell and
  // volume? `lowest`: the corner nearest to the latter plane, or farthest behind it.
  HWY_INLINE M is_apart(Point& lowest) const {
    M apart = is_beside(sum_of_corners(), lowest);
    each_face([&](const Point& normal, V offset) {
      const V scale = all(1.0f) / face_length(normal);
      const V beyond = scale * (dot(normal, cone_.apex) - offset);
      apart = Or(apart, beyond - extent_of(cone_, Neg(scale) * normal, all(1.0f)) > tolerance_);
    });
    return apart;
  }

  // Refinement, no: tries more planes along the cone's side, to find the one with the widest gap. That plane leans
  // towards one corner, or is equally far from two corners; each plane's lowest corner is used for the next plane.
  // `lowest`: from is_apart().
  HWY_INLINE M refine_by_cone_planes(const Point& lowest) const {
    Point next, third, last;
    M beside = is_beside(lowest, next);
    beside = Or(beside, is_beside(equally_far_from(lowest, next), third));
    beside = Or(beside, is_beside(equally_far_from(lowest, third), last));
    return Or(beside, is_beside(equally_far_from(next, third), last));
  }

  // The direction across the axis in which a plane along the cone's side is equally far from two points: cosine *
  // (direction · step) = sine * (axis · step). NaN if there is none. Of the two solutions the one on a's side.
  HWY_INLINE Point equally_far_from(const Point& a, const Point& b) const {
    const Point step = b - a;
    const V along = dot(step, cone_.axis);
    const Point part = step - along * cone_.axis;
    const V size = length(part);
    const Point forth = (all(1.0f) / size) * part, aside = cross(cone_.axis, forth);
    const V ahead = cone_.sine * along / (cone_.cosine * size), beside = Sqrt(all(1.0f) - ahead * ahead);
    return ahead * forth + IfThenElse(dot(aside, a) < Zero(D()), Neg(beside), beside) * aside;
  }

  // Refinement, both answers: tests points on the edges, then projects a point from the cell to the volume and back a
  // few times. Both sets are made smaller by a little more than the tolerance. If they overlap, the point is soon in
  // both; if not, a plane across the way between the two projections separates them.
  HWY_INLINE void refine_by_projections(M& common, M& apart) const {
    constexpr int k_ways = 8;
    Point in_cell = all(0.125f) * sum_of_corners();
    for (int way = 0; way < k_ways; ++way) in_cell = closer_to_volume(in_cell);
    const Point in_volume = nearest_in_volume(in_cell), way = in_cell - in_volume;
    common = Or(common, Or(has_edge_point_in_volume(), Or(is_common(in_cell), is_common(in_volume))));
    const Point normal = (all(1.0f) / length(way)) * way;
    Point lowest;
    const M is_past = least_along(normal, lowest) - extent_of(cone_, normal, all(1.0f)) > tolerance_;
    apart = Or(apart, And(dot(way, way) > all(1e-30f), is_past));
  }

  // Is a point of an edge in the volume? For each edge it tests the point nearest to the axis as an angle, the point
  // nearest to the apex, and their midpoint; these points are off the edge by a few roundoffs.
  HWY_INLINE M has_edge_point_in_volume() const {
    M any = Not(yes());
    for (unsigned corner = 0; corner < 8; ++corner)
      for (const unsigned bit : {1u, 2u, 4u}) {
        if ((corner & bit) != 0) continue;
        const Point start = from_apex_[corner], step = from_apex_[corner | bit] - start;
        const V start_axis = dot(start, cone_.axis), step_axis = dot(step, cone_.axis), mixed = dot(start, step);
        const V start_square = dot(start, start), step_square = dot(step, step);
        const V above = step_axis * start_square - start_axis * mixed;
        const V below = start_axis * step_square - step_axis * mixed;
        const auto within = [](V t) { return clamped(Zero(D()), t, all(1.0f)); };
        const V to_axis = within(above / below), to_apex = within(Neg(mixed) / step_square);
        for (const V t : {to_axis, to_apex, all(0.5f) * (to_axis + to_apex)})
          any = Or(any, is_inside(start + t * step));
      }
    return any;
  }

  // From a point of the cell to the volume and back, a little too far, for faster convergence.
  HWY_INLINE Point closer_to_volume(const Point& v) const {
    const Point beyond = v + all(1.5f) * (nearest_in_volume(v) - v), back = near_in_cell(beyond);
    if constexpr (orthographic) return back;
    // Then further along the cell's leaning sides.
    const Point side = back + cone_.apex;
    return near_in_cell(beyond, side.depth * (dot(beyond - back, side) / dot(side, side)));
  }

  // A point of the smaller cell (smaller by a little more than the tolerance) close to v: at the depth of v + `deeper`,
  // clamped to the cell. Where the sides lean it is not the nearest point.
  HWY_INLINE Point near_in_cell(const Point& v, V deeper = Zero(D())) const {
    const V within = all(k_within) * tolerance_;
    const Point point = v + cone_.apex;
    const V depth = clamped(rows_.depth0 + within, point.depth + deeper, rows_.depth1 - within);
    const V w = w_of<orthographic>(depth);
    const auto inset = [&](V slope) { return within * (all(1.0f) + w_along<orthographic>(Abs(slope))); };
    const auto between = [&](V low, V at, V high) { return clamped(low * w + inset(low), at, high * w - inset(high)); };
    return Point{between(left_, point.x, right_), between(rows_.y0, point.y, rows_.y1), depth} - cone_.apex;
  }

  // The tests that prove:

  // Is the point apex + v in volume and cell, by more than the tolerance?
  HWY_INLINE M is_common(const Point& v) const { return And(is_inside(v), is_in_cell(v)); }

  // Do all corners lie beyond the plane along the cone's side in the direction of v? `lowest`: the corner nearest to
  // that plane.
  HWY_INLINE M is_beside(const Point& v, Point& lowest) const {
    const Point part = v - dot(v, cone_.axis) * cone_.axis;
    // Where v is nearly along the axis, its part across has few digits, and squares below 1e-15 lose theirs or
    // underflow to 0. Elsewhere up to 65 u of that part is still along the axis; a second projection leaves 6 u.
    const M is_good = dot(part, part) > Max(all(0.01f) * dot(v, v), all(1e-30f));
    const Point across = part - dot(part, cone_.axis) * cone_.axis;
    const Point outwards = (cone_.cosine / length(across)) * across - cone_.sine * cone_.axis;
    return And(is_good, least_along(outwards, lowest) > tolerance_);
  }

 private:
  static constexpr float k_within = 1.25f;  // of the tolerance

  HWY_INLINE static M yes() { return Zero(D()) == Zero(D()); }

  HWY_INLINE Point sum_of_corners() const {
    Point sum = from_apex_[0];
    for (unsigned i = 1; i < 8; ++i) sum = sum + from_apex_[i];
    return sum;
  }

  // The nearest point of the smaller volume: its apex is moved along the axis, its range is shorter.
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

  // Is the point inside the cell by more than the tolerance?
  HWY_INLINE M is_in_cell(const Point& v) const {
    M is_in = yes();
    each_face([&](const Point& outward, V offset) {
      is_in = And(is_in, offset - dot(outward, cone_.apex + v) > tolerance_ * face_length(outward));
    });
    return is_in;
  }

  HWY_INLINE Point corner(unsigned i) const {
    const V depth = (i & 4) != 0 ? rows_.depth1 : rows_.depth0, w = w_of<orthographic>(depth);
    return {((i & 1) != 0 ? right_ : left_) * w, ((i & 2) != 0 ? rows_.y1 : rows_.y0) * w, depth};
  }

  // Visits the outward normals (any length) and the offset of each face along its normal.
  template <class Visit>
  HWY_INLINE void each_face(Visit&& visit) const {
    const V zero = Zero(D()), plus = all(1.0f), minus = all(-1.0f);
    const auto leaning = [](V slope) { return w_along<orthographic>(slope); };
    const auto offset = [&](V slope) {
      return orthographic ? slope : zero;
    };  // in perspective the side planes contain the eye
    visit(Point{minus, zero, leaning(left_)}, offset(Neg(left_)));
    visit(Point{plus, zero, leaning(Neg(right_))}, offset(right_));
    visit(Point{zero, minus, leaning(rows_.y0)}, offset(Neg(rows_.y0)));
    visit(Point{zero, plus, leaning(Neg(rows_.y1))}, offset(rows_.y1));
    visit(depth_axis(-1.0f), Neg(rows_.depth0));
    visit(depth_axis(), rows_.depth1);
  }

  // The length of a face's normal.
  static HWY_INLINE V face_length(const Point& outward) {
    if constexpr (orthographic) return all(1.0f);
    return length(outward);
  }

  // The least value of the corners along a direction, and the corner that has it.
  HWY_INLINE V least_along(const Point& direction, Point& lowest) const {
    lowest = from_apex_[0];
    V least = dot(direction, lowest);
    for (unsigned i = 1; i < 8; ++i) {
      const V height = dot(direction, from_apex_[i]);
      lowest = chosen(height < least, from_apex_[i], lowest);
      least = Min(least, height);
    }
    return least;
  }

  // Is the point apex + v in the volume, by more than the tolerance?
  HWY_INLINE M is_inside(const Point& v) const {
    const V zero = Zero(D()), along = dot(v, cone_.axis);
    const Point offset = v - along * cone_.axis;
    // Compares squares, because roots are slow. This adds a few u to the errors that the tolerance covers.
    const V side = cone_.sine * along - tolerance_;
    const M is_in_cone = And(side > zero, side * side > cone_.cosine * cone_.cosine * dot(offset, offset));
    return And(is_in_cone, And(safe_range_ > zero, dot(v, v) < safe_range_ * safe_range_));
  }

  const SpotsInRows& rows_;
  const Cone& cone_;
  V left_, right_, tolerance_, safe_range_;
  Point from_apex_[8];
};

}  // namespace clusterbench::assign::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
