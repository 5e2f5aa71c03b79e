#pragma once
// Steps that the proofs of spots against plane cells and against shell cells share.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "geom/certificate/rational_spot.h"
#include "geom/certificate/spot_106.h"
#include "geom/numbers/double_double.h"
#include "geom/numbers/precision.h"
#include "geom/search/common_point.h"
#include "geom/search/separating_plane.h"

namespace clusterbench::geom {

inline RationalPoint at(const ExactSpot& spot, const Rational& t) {
  return spot.apex + t * spot.direction;
}

// Does the apex, which is not in the cell, lie in or beyond one of the cell's planes, so that all directions of the
// cone certainly lead away from this plane?
inline bool surely_leans_away(const ExactSpot& spot, const Planes& planes) {
  const Rational most = squared(spot.half_angle.sine.hi) * dot(spot.direction, spot.direction);
  return std::any_of(planes.begin(), planes.end(), [&](const HalfSpace<Rational>& plane) {
    if (plane.margin(spot.apex).sign() > 0) return false;
    const Rational along = dot(plane.normal, spot.direction);
    return along.sign() > 0 && squared(along) > most * dot(plane.normal, plane.normal);
  });
}

// The precision of the half-angle's cosine and sine for the proof of a search in Real.
template <class Real>
constexpr unsigned angle_bits_for() {
  return Precision<Real>::k_tolerance_bits + (Precision<Real>::k_tolerance_bits < 1000 ? 160 : 500);
}

// On lattices, rims of spots touch edges up to rounding. The point nearest to the apex, found in doubles, shows between
// which faces the edge is; only there the plane is searched in sums of two doubles, at a fifth of the time.
template <class PlaneCell>
bool is_apart_where_nearest(const SpotVolume& light, const PlaneCell& cell, const Spot106& spot) {
  const Polytope<double> roughly = polytope_of<double>(cell);
  const Setting<double> rough_setting(volume_of<double>(light), roughly);
  const std::optional<Point3<double>> near = nearest_in_cone(rough_setting);
  if (!near) return false;
  std::array<bool, 6> on_faces;
  for (std::size_t i = 0; i < 6; ++i)
    on_faces[i] = std::abs(roughly.faces[i].margin(*near)) <= 16.0 * rough_setting.tolerance;
  const Polytope<DoubleDouble> polytope = polytope_of<DoubleDouble>(cell);
  const Setting<DoubleDouble> setting(volume_of<DoubleDouble>(light), polytope);
  const std::optional<Point3<DoubleDouble>> nearest = nearest_in_cone(setting, on_faces);
  if (!nearest) return false;
  Separator<DoubleDouble> separator(setting.volume, setting.cell);
  separator.try_leaning(*nearest);
  if (!(separator.best().gap > DoubleDouble(0.0))) return false;
  std::array<Point106, 8> corners;
  for (std::size_t i = 0; i < 8; ++i) corners[i] = corner_of(cell, i);
  return spot.surely_separated(point_106(separator.best().normal), corners);
}

// The light with its range limited to the points of a cell, which are at most `farthest` from the eye. Searches and
// proofs have to use the same range: a point that a search finds beyond the proof's range would prove nothing.
inline SpotVolume limited(SpotVolume light, double farthest) {
  constexpr double k_least = 1e-150;  // a smaller length may underflow to 0
  const LocalPoint apex = local_point(light.apex);
  light.range = std::min(light.range, 1.01 * (glm::length(apex.at) + 2.0 * apex.rounding_error + farthest) + k_least);
  return light;
}

}  // namespace clusterbench::geom
