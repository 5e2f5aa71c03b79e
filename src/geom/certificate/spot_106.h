#pragma once
// Proofs about a spot in numbers of 106 bits with error bounds (geom/numbers/enclosure_106.h): that it contains a
// point, that a plane lies between it and corners. geom/certificate/rational_spot.h proves the same in exact numbers,
// for cases that these cannot decide.

#include <algorithm>
#include <array>
#include <initializer_list>

#include "geom/numbers/enclosure_106.h"
#include "geom/numbers/point3.h"
#include "geom/shapes/cell.h"
#include "geom/shapes/light_volume.h"
#include "geom/shapes/verdict.h"

namespace clusterbench::geom {

using Point106 = Point3<Enclosure106>;

// The exact point: sums of two doubles have radius 0.
inline Point106 point_106(const Point3<DoubleDouble>& p) {
  return {Enclosure106(p.x), Enclosure106(p.y), Enclosure106(p.z)};
}
inline Point106 point_106(const Point3<double>& p) {
  return {Enclosure106(p.x), Enclosure106(p.y), Enclosure106(p.z)};
}

inline bool all_positive(std::initializer_list<Enclosure106> values) {
  const Enclosure106 zero(0.0);
  return std::all_of(values.begin(), values.end(), [&](const Enclosure106& value) { return zero < value; });
}

// Is p certainly between the four planes through the eye?
inline bool surely_in_tile(float x0, float x1, float y0, float y1, const Point106& p) {
  const Enclosure106 depth = -p.z;
  return all_positive({depth, p.x - Enclosure106(x0) * depth, Enclosure106(x1) * depth - p.x,
                       p.y - Enclosure106(y0) * depth, Enclosure106(y1) * depth - p.y});
}
// Is p certainly in the cell?
inline bool surely_in(const Box& cell, const Point106& p) {
  return all_positive({p.x - Enclosure106(cell.lo.x), Enclosure106(cell.hi.x) - p.x, p.y - Enclosure106(cell.lo.y),
                       Enclosure106(cell.hi.y) - p.y, p.z - Enclosure106(cell.lo.z), Enclosure106(cell.hi.z) - p.z});
}
inline bool surely_in(const FrustumCell& c, const Point106& p) {
  if (c.orthographic) return surely_in(Box{{c.x0, c.y0, -c.depth1}, {c.x1, c.y1, -c.depth0}}, p);
  return all_positive({-p.z - Enclosure106(c.depth0), Enclosure106(c.depth1) + p.z}) &&
         surely_in_tile(c.x0, c.x1, c.y0, c.y1, p);
}

// Corner i of a cell, in the order of geom/shapes/polytope.h.
inline Point106 corner_of(const Box& cell, std::size_t i) {
  return {Enclosure106((i & 1) != 0 ? cell.hi.x : cell.lo.x), Enclosure106((i & 2) != 0 ? cell.hi.y : cell.lo.y),
          Enclosure106((i & 4) != 0 ? cell.lo.z : cell.hi.z)};
}
inline Point106 corner_of(const FrustumCell& c, std::size_t i) {
  if (c.orthographic) return corner_of(Box{{c.x0, c.y0, -c.depth1}, {c.x1, c.y1, -c.depth0}}, i);
  const Enclosure106 depth((i & 4) != 0 ? c.depth1 : c.depth0);
  return {Enclosure106((i & 1) != 0 ? c.x1 : c.x0) * depth, Enclosure106((i & 2) != 0 ? c.y1 : c.y0) * depth, -depth};
}

// ball(apex, range) ∩ solid cone around direction (any length but 0).
struct Spot106 {
  Point106 apex, direction;
  Enclosure106 range, cosine, sine;

  // range_m: finite; the light's range, limited to the part that matters.
  Spot106(const SpotVolume& light, double range_m);

  // Is a direction from the apex (at less than 90° from the axis) in the cone?
  Verdict leans(const Point106& way) const;
  // Is its angle to all directions of the cone certainly more than 90°?
  bool surely_leans_away(const Point106& way) const;
  // Does the volume certainly contain p?
  bool surely_holds(const Point106& p) const;
  // Does a plane with this normal (from the volume to the corners; any length) certainly lie between?
  bool surely_separated(const Point106& normal, const std::array<Point106, 8>& corners) const;
  // As above, but between the volume and all p with |p| <= radius.
  bool surely_separated(const Point106& normal, const Enclosure106& radius) const;

 private:
  template <std::size_t N>
  bool is_surely_below(const Point106& normal, const std::array<Enclosure106, N>& least) const;
};

}  // namespace clusterbench::geom
