// Points, cones and rows in vectors, each lane with its own spot, and how well they are measured. For files that are
// compiled once per target.

#if defined(CLUSTERBENCH_SPOT_VECTORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLUSTERBENCH_SPOT_VECTORS_INL_H
#undef CLUSTERBENCH_SPOT_VECTORS_INL_H
#else
#define CLUSTERBENCH_SPOT_VECTORS_INL_H
#endif

#include "assign/cone/spot_cell_filter.h"
#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign::HWY_NAMESPACE {

// Points and directions as x to the right, y up, depth ahead; each coordinate a vector of numbers.
template <class Numbers>
struct PointOf {
  Numbers x, y, depth;
};
template <class T>
HWY_INLINE PointOf<T> operator+(const PointOf<T>& a, const PointOf<T>& b) {
  return {a.x + b.x, a.y + b.y, a.depth + b.depth};
}
template <class T>
HWY_INLINE PointOf<T> operator-(const PointOf<T>& a, const PointOf<T>& b) {
  return {a.x - b.x, a.y - b.y, a.depth - b.depth};
}
template <class T>
HWY_INLINE PointOf<T> operator*(T s, const PointOf<T>& a) {
  return {s * a.x, s * a.y, s * a.depth};
}
template <class T>
HWY_INLINE T dot(const PointOf<T>& a, const PointOf<T>& b) {
  return a.x * b.x + a.y * b.y + a.depth * b.depth;
}
template <class T>
HWY_INLINE T length(const PointOf<T>& a) {
  return Sqrt(dot(a, a));
}

using Point = PointOf<V>;
HWY_INLINE Point cross(const Point& a, const Point& b) {
  return {a.y * b.depth - a.depth * b.y, a.depth * b.x - a.x * b.depth, a.x * b.y - a.y * b.x};
}

// Unit vectors along an axis, or (side -1) against it.
HWY_INLINE Point x_axis(float side = 1.0f) {
  return {all(side), Zero(D()), Zero(D())};
}
HWY_INLINE Point y_axis() {
  return {Zero(D()), all(1.0f), Zero(D())};
}
HWY_INLINE Point depth_axis(float side = 1.0f) {
  return {Zero(D()), Zero(D()), all(side)};
}

HWY_INLINE Point chosen(M where, const Point& a, const Point& b) {
  return {IfThenElse(where, a.x, b.x), IfThenElse(where, a.y, b.y), IfThenElse(where, a.depth, b.depth)};
}

// The w of clip space, by which a point is divided to be projected: its depth, without perspective 1. A slope is
// x / w or y / w. And by how much w differs between the ends of a way.
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

// Evidence: a point that is in cell and volume, or a plane between them, by more than the tolerance 2^-19 S = 32 u S;
// u = 2^-24, S = |apex| + 2 range + the cell's largest coordinates. A point counts as apex + v, exactly; a plane's
// normal as it came out, of length 1 to 5 u, or of another one by which all margins and the tolerance are then larger.
// How either was found does not matter, only how well it is measured. Given numbers are off by u of themselves: range,
// sine, cosine and each coordinate of apex and axis. Sums and products of three lose 3 u of the vectors' lengths, a
// length 3 u. Then margins are off by at most
//    9 u S  of a point in the sphere: 5 u range, u |apex|; in the cone: along the axis 4 u range + u |apex|, across it
//           3 u range + u |apex|, both times sine and cosine, squared and compared 5 u range
//    6 u S  of a point in the cell: apex + v is rounded, 2 u of a product and a sum
//    5 u S  of corners along a normal: u of a corner, u of it from the apex, 3 u of the product
//   10 u S  of how far the volume extends along a normal: along the axis 6 u range, across it 11 u range, 3 u for the
//   rest
//    7 u S  of a plane along the cone's side, whose extent is taken to be 0: its direction across the axis is at right
//           angles to it to 6 u, of length 1 to 5 u, and 3 u for the rest, times range
//   10 u S  of the apex from a face: 5 u for the product and the offset, 5 u for the length of the normal
// so under 20 u S for a plane.
constexpr float k_tolerance = 0x1p-19f;

// Evidence must be larger than this. `light`: the size of the numbers that describe it; the cells reach to a depth, and
// to slopes across and up (without perspective these are coordinates; then corners and normals are exact).
template <bool orthographic>
HWY_INLINE V tolerance_of(V light, V depth, V across, V up) {
  const V sideways = across + up;
  return all(k_tolerance) * (light + (orthographic ? depth + sideways : depth * (all(1.0f) + sideways)));
}

// How far a volume extends from its apex along a normal of this length. What is across the axis is measured as a
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
  V light;  // size of the numbers that describe it

  HWY_INLINE GivenSpots(const view::LightArrays& lights, VI spot) {
    // Gathering takes longer than much of what follows, and where spots are few, vectors are often of one.
    const std::int32_t first = GetLane(spot);
    if (AllTrue(DI(), spot == all(first)))
      take(lights, [&](const float* from) { return all(from[first]); });
    else
      take(lights, [&](const float* from) { return gathered(from, spot); });
  }

 private:
  template <class Get>
  HWY_INLINE void take(const view::LightArrays& lights, Get&& get) {
    const std::uint32_t points = lights.spots.first;
    cone = {{get(lights.x.data() + points), get(lights.y.data() + points), Neg(get(lights.z.data() + points))},
            {get(lights.axis_x.data()), get(lights.axis_y.data()), Neg(get(lights.axis_z.data()))},
            get(lights.radius.data() + points),
            get(lights.cos_angle.data()),
            get(lights.sin_angle.data())};
    light = get(lights.reach.data() + points) + cone.range;
  }
};

// Which spots of these sizes are to be judged in single precision.
HWY_INLINE M are_plain(const RowPlanes& planes, V light) {
  return is_between(all(planes.least_reach), light, all(k_most_row_reach));
}

// Spots, each with its own run of a row: tile planes below and above, slice planes in front and behind.
struct SpotsInRows {
  Cone cone;
  V light;  // GivenSpots::light
  V y0, y1, depth0, depth1;

  // Where columns between two sides are looked at.
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

}  // namespace clusterbench::assign::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
