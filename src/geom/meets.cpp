#include "geom/meets.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/candidates.h"
#include "geom/exact_ball.h"
#include "geom/exact_shell.h"
#include "geom/search.h"
#include "geom/separation.h"
#include "geom/spot.h"

namespace clusterbench::geom {
namespace {

// A corner well inside the volume settles most pairs, a plane along the cone's side most others.
template <class Real>
Verdict corners_settle(const Volume<Real>& volume, const Polytope<Real>& cell, const Real& tolerance) {
  Point3<Real> sum{Real(0), Real(0), Real(0)};
  const Real safe_range = volume.range - tolerance;
  for (const Point3<Real>& corner : cell.corners) {
    const Point3<Real> v = corner - volume.apex;
    if (safe_range > Real(0) && dot(v, v) < safe_range * safe_range && volume.side_margin(corner) > tolerance)
      return Verdict::yes;
    sum = sum + v;
  }
  const Point3<Real> outward =
      volume.cos_angle * unit_across(volume.axis, sum) - volume.sin_angle * volume.axis;  // of the cone's side
  for (const Point3<Real>& corner : cell.corners)
    if (dot(outward, corner - volume.apex) <= tolerance) return Verdict::open;
  return Verdict::no;
}

template <class Real>
Verdict meets_polytope(const Volume<Real>& unlimited, const Polytope<Real>& cell) {
  const Setting<Real> setting(unlimited, cell);
  const Volume<Real>& volume = setting.volume;
  const Reached<6> reached = reached_faces(volume, cell.faces, setting.tolerance);
  if (reached.is_beyond) return Verdict::no;
  if (volume.is_cone) {
    const Verdict verdict = corners_settle(volume, cell, setting.tolerance);
    if (verdict != Verdict::open) return verdict;
  }
  const Witness<Real> witness = setting.common_point(reached.faces);
  if (witness.margin > setting.tolerance) return Verdict::yes;
  return witness.margin < Real(0) && find_separation(volume, cell, setting.tolerance).gap > setting.tolerance
             ? Verdict::no
             : Verdict::open;
}

template <class Real>
Verdict meets_shell(const Volume<Real>& unlimited, const ShellPiece& cell) {
  const Volume<Real> volume = within(unlimited, Real(cell.distance1));
  const PyramidReach<Real> reach = pyramid_reach(volume, pyramid_of<Real>(cell.x0, cell.x1, cell.y0, cell.y1));
  const Real near(cell.distance0), far(cell.distance1);
  if (reach.is_empty || reach.lo > far + reach.tolerance || reach.hi < near - reach.tolerance) return Verdict::no;
  if (!(reach.inside.margin > reach.tolerance)) return Verdict::open;
  const bool surely_near =
      reach.lo + pull(reach, reach.nearest) <= far || length(reach.inside.at) <= far - reach.tolerance;
  const bool surely_far =
      reach.hi - pull(reach, reach.farthest) >= near || length(reach.inside.at) >= near + reach.tolerance;
  return surely_near && surely_far ? Verdict::yes : Verdict::open;
}

template <class Real>
struct Meets {
  const Volume<Real>& volume;

  Verdict operator()(const FrustumPiece& cell) const { return meets_polytope(volume, polytope_of<Real>(cell)); }
  Verdict operator()(const Box& cell) const { return meets_polytope(volume, polytope_of<Real>(cell)); }
  Verdict operator()(const ShellPiece& cell) const { return meets_shell(volume, cell); }
};

struct Decides {
  const LightVolume& light;

  template <class AnyCell>
  Verdict operator()(const AnyCell& cell) const {
    if (light.is_cone) return decide_spot(light, cell);
    return ball_meets_exactly(light.apex, light.range, cell) ? Verdict::yes : Verdict::no;
  }
};

}  // namespace

LightFilter::LightFilter(const LightVolume& light) : volume_(volume_of<double>(light)) {}

Verdict LightFilter::meets(const Cell& cell) const {
  return std::visit(Meets<double>{volume_}, cell);
}

DistanceInterval LightFilter::distances(const ShellPiece& tile) const {
  constexpr double k_infinity = std::numeric_limits<double>::infinity();
  if (std::isinf(volume_.range)) return {0.0, k_infinity, 1.0, 0.0};  // each shell on its own
  const PyramidReach<double> reach = pyramid_reach(volume_, pyramid_of<double>(tile.x0, tile.x1, tile.y0, tile.y1));
  if (reach.is_empty) return {};
  DistanceInterval interval{reach.lo - reach.tolerance, reach.hi + reach.tolerance, 1.0, 0.0};
  if (reach.inside.margin > reach.tolerance) {
    interval.inner_lo = reach.lo + pull(reach, reach.nearest);
    interval.inner_hi = reach.hi - pull(reach, reach.farthest);
  }
  return interval;
}

Verdict filter_meets(const LightVolume& light, const Cell& cell) {
  return LightFilter(light).meets(cell);
}

Verdict decide_meets(const LightVolume& light, const Cell& cell) {
  if (!light.is_cone && std::isinf(light.range)) return Verdict::yes;
  if (holds_exactly(cell, light.apex)) return Verdict::yes;
  return std::visit(Decides{light}, cell);
}

}  // namespace clusterbench::geom
