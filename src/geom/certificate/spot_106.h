#pragma once
// Proofs about a spot in numbers of 106 bits between bounds (geom/numbers/enclosure_106.h): that it holds a point, that
// a plane lies between it and corners. The same as geom/certificate/rational_spot.h proves in exact numbers, where
// these cannot tell.

#include <algorithm>
#include <array>
#include <initializer_list>

#include "geom/numbers/enclosure_106.h"
#include "geom/numbers/point3.h"
#include "geom/shapes/cell.h"
#include "geom/shapes/light_volume.h"
#include "geom/shapes/verdict.h"

namespace clusterbench::geom {

using TightPoint = Point3<Tight>;

// Exactly the point: sums of two doubles have no radius.
inline TightPoint tight(const Point3<Twofold>& p) {
  return {Tight(p.x), Tight(p.y), Tight(p.z)};
}
inline TightPoint tight(const Point3<double>& p) {
  return {Tight(p.x), Tight(p.y), Tight(p.z)};
}

inline bool all_positive(std::initializer_list<Tight> values) {
  const Tight zero(0.0);
  return std::all_of(values.begin(), values.end(), [&](const Tight& value) { return zero < value; });
}

// Is p certainly between the four planes through the eye?
inline bool surely_in_tile(float x0, float x1, float y0, float y1, const TightPoint& p) {
  const Tight depth = -p.z;
  return all_positive(
      {depth, p.x - Tight(x0) * depth, Tight(x1) * depth - p.x, p.y - Tight(y0) * depth, Tight(y1) * depth - p.y});
}
// Is p certainly in the cell?
inline bool surely_in(const Box& cell, const TightPoint& p) {
  return all_positive({p.x - Tight(cell.lo.x), Tight(cell.hi.x) - p.x, p.y - Tight(cell.lo.y), Tight(cell.hi.y) - p.y,
                       p.z - Tight(cell.lo.z), Tight(cell.hi.z) - p.z});
}
inline bool surely_in(const FrustumPiece& c, const TightPoint& p) {
  if (c.orthographic) return surely_in(Box{{c.x0, c.y0, -c.depth1}, {c.x1, c.y1, -c.depth0}}, p);
  return all_positive({-p.z - Tight(c.depth0), Tight(c.depth1) + p.z}) && surely_in_tile(c.x0, c.x1, c.y0, c.y1, p);
}

// Corner i of a cell, as geom/shapes/polytope.h counts them.
inline TightPoint corner_of(const Box& cell, std::size_t i) {
  return {Tight((i & 1) != 0 ? cell.hi.x : cell.lo.x), Tight((i & 2) != 0 ? cell.hi.y : cell.lo.y),
          Tight((i & 4) != 0 ? cell.lo.z : cell.hi.z)};
}
inline TightPoint corner_of(const FrustumPiece& c, std::size_t i) {
  if (c.orthographic) return corner_of(Box{{c.x0, c.y0, -c.depth1}, {c.x1, c.y1, -c.depth0}}, i);
  const Tight depth((i & 4) != 0 ? c.depth1 : c.depth0);
  return {Tight((i & 1) != 0 ? c.x1 : c.x0) * depth, Tight((i & 2) != 0 ? c.y1 : c.y0) * depth, -depth};
}

// ball(apex, range) ∩ solid cone around direction (any length but 0).
struct TightSpot {
  TightPoint apex, direction;
  Tight range, cosine, sine;

  // range_m: finite, and the light's range as far as it matters.
  TightSpot(const LightVolume& light, double range_m);

  // Is a direction from the apex (at less than 90° from the axis) in the cone?
  Verdict leans(const TightPoint& way) const;
  // Does it certainly lean more than 90° from all of the cone's?
  bool surely_leans_away(const TightPoint& way) const;
  // Does the volume certainly hold p?
  bool surely_holds(const TightPoint& p) const;
  // Does a plane with this normal (from the volume to the corners; any length) certainly lie between?
  bool surely_separated(const TightPoint& normal, const std::array<TightPoint, 8>& corners) const;
  // The same between the volume and all p with |p| <= radius.
  bool surely_separated(const TightPoint& normal, const Tight& radius) const;

 private:
  template <std::size_t N>
  bool is_surely_below(const TightPoint& normal, const std::array<Tight, N>& least) const;
};

}  // namespace clusterbench::geom
