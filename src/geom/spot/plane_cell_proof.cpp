#include <algorithm>
#include <array>

#include "geom/numbers/wide_float.h"
#include "geom/spot/proof_by_search.h"
#include "geom/spot/proof_steps.h"

namespace clusterbench::geom {
namespace {

// Does the axis enter the cell? A cone of half-angle 0 has no other points.
bool axis_surely_meets(const ExactSpot& spot, const Planes& planes) {
  const std::optional<Span> span = span_within(planes, spot.apex, spot.direction);
  return span && surely_holds(spot, at(spot, span->from));
}

// A spot (limited to its cell) and a cell bounded by planes, ready for checks.
struct PlaneCase {
  std::array<RationalPoint, 8> corners;
  Planes planes;
  ExactSpot spot;

  template <class PlaneCell>
  PlaneCase(const SpotVolume& light, const PlaneCell& cell, unsigned angle_bits)
      : corners(corners_of(cell)), planes(planes_of(cell)), spot(exact_spot(light, angle_bits)) {}
};

// Searches in Real, and checks the results between bounds of 106 bits. Faces that the volume clearly does not reach, in
// double precision, have no candidates.
template <class Real, class PlaneCell>
Verdict proven_in_106_bits(const SpotVolume& light, const PlaneCell& cell, const std::array<bool, 6>& reached,
                           const Spot106& spot) {
  const Polytope<Real> polytope = polytope_of<Real>(cell);
  const Setting<Real> setting(volume_of<Real>(light), polytope);
  const Witness<Real> witness = setting.common_point(reached);
  if (witness.margin > Real(0)) {
    const Point106 p = point_106(witness.at);
    if (surely_in(cell, p) && spot.surely_holds(p)) return Verdict::yes;
  }
  const Separation<Real> separation = find_separation(setting);
  if (!(separation.gap > Real(0))) return Verdict::uncertain;
  std::array<Point106, 8> corners;
  for (std::size_t i = 0; i < 8; ++i) corners[i] = corner_of(cell, i);
  return spot.surely_separated(point_106(separation.normal), corners) ? Verdict::no : Verdict::uncertain;
}

double farthest_corner(const Polytope<double>& polytope) {
  double farthest = 0.0;
  for (const Point3<double>& corner : polytope.corners) farthest = std::max(farthest, length(corner));
  return farthest;
}

// Searches in Real, and checks the results exactly. The apex is not in the cell.
template <class Real, class PlaneCell>
Verdict proven_by_search(const SpotVolume& light, const PlaneCell& cell, const PlaneCase& exactly) {
  if (surely_leans_away(exactly.spot, exactly.planes)) return Verdict::no;
  const Polytope<Real> polytope = polytope_of<Real>(cell);
  const Setting<Real> setting(volume_of<Real>(light), polytope);
  const Witness<Real> witness = setting.common_point({true, true, true, true, true, true});
  if (witness.margin > Real(0)) {
    const RationalPoint p = exact(witness.at);
    if (all_hold(exactly.planes, p) && surely_holds(exactly.spot, p)) return Verdict::yes;
  }
  const Separation<Real> separation = find_separation(setting);
  const bool is_apart =
      separation.gap > Real(0) && surely_separates(exact(separation.normal), exactly.spot, exactly.corners);
  return is_apart ? Verdict::no : Verdict::uncertain;
}

template <class PlaneCell>
Verdict decide(const SpotVolume& given, const PlaneCell& cell) {
  const Polytope<double> polytope = polytope_of<double>(cell);
  const SpotVolume light = limited(given, farthest_corner(polytope));
  const Setting<double> setting(volume_of<double>(light), polytope);
  const std::array<bool, 6> reached = reached_faces(setting.volume, polytope.faces, setting.tolerance).faces;
  const Spot106 spot_106(light, light.range);
  Verdict verdict = proven_in_106_bits<double>(light, cell, reached, spot_106);
  if (verdict == Verdict::uncertain && is_apart_where_nearest(light, cell, spot_106)) return Verdict::no;
  if (verdict == Verdict::uncertain) verdict = proven_in_106_bits<DoubleDouble>(light, cell, reached, spot_106);
  if (verdict != Verdict::uncertain) return verdict;
  const PlaneCase exactly(light, cell, angle_bits_for<Float256>());
  if (surely_holds(exactly.spot, nearest_point(cell, exactly.spot.apex))) return Verdict::yes;
  if (axis_surely_meets(exactly.spot, exactly.planes)) return Verdict::yes;
  verdict = proven_by_search<Float256>(light, cell, exactly);
  // Cones of 1e-60 rad, and doubles next to 0 beside others: both differ from touching by less than 256 bits can
  // resolve.
  if (verdict == Verdict::uncertain)
    verdict = proven_by_search<Float1024>(light, cell, PlaneCase(light, cell, angle_bits_for<Float1024>()));
  if (verdict == Verdict::uncertain)
    verdict = proven_by_search<Float3072>(light, cell, PlaneCase(light, cell, angle_bits_for<Float3072>()));
  return verdict;
}

}  // namespace

Verdict decide_spot(const SpotVolume& light, const FrustumCell& cell) {
  return decide(light, cell);
}

Verdict decide_spot(const SpotVolume& light, const Box& cell) {
  return decide(light, cell);
}

}  // namespace clusterbench::geom
