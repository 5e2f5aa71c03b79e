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
Verdict corners_settle(const Volume<double>& volume, const Polytope<double>& cell, double tolerance) {
  Point3<double> sum{0.0, 0.0, 0.0};
  const double safe_range = volume.range - tolerance;
  for (const Point3<double>& corner : cell.corners) {
    const Point3<double> v = corner - volume.apex;
    if (safe_range > 0.0 && dot(v, v) < safe_range * safe_range && volume.side_margin(corner) > tolerance)
      return Verdict::yes;
    sum = sum + v;
  }
  const Point3<double> outward =
      volume.cos_angle * unit_across(volume.axis, sum) - volume.sin_angle * volume.axis;  // of the cone's side
  for (const Point3<double>& corner : cell.corners)
    if (dot(outward, corner - volume.apex) <= tolerance) return Verdict::open;
  return Verdict::no;
}

Verdict meets_polytope(const Volume<double>& unlimited, const Polytope<double>& cell) {
  const Setting<double> setting(unlimited, cell);
  const Volume<double>& volume = setting.volume;
  const Reached<6> reached = reached_faces(volume, cell.faces, setting.tolerance);
  if (reached.is_beyond) return Verdict::no;
  if (volume.is_cone) {
    const Verdict verdict = corners_settle(volume, cell, setting.tolerance);
    if (verdict != Verdict::open) return verdict;
  }
  const Witness<double> witness = setting.common_point(reached.faces);
  if (witness.margin > setting.tolerance) return Verdict::yes;
  const bool may_be_apart = witness.margin < 0.0;
  return may_be_apart && find_separation(setting).gap > setting.tolerance ? Verdict::no : Verdict::open;
}

// A point as a pyramid sees it. The pyramid's point nearest to it at distance t >= 0 from the eye is
// sqrt((t - along)² + aside²) away, whatever t is: t u for the one direction u with the largest u·p (exact_cells.cpp).
struct Sight {
  double along, aside;
};

// u is the point's own direction, if that is in the pyramid, or else lies on a face. There it is searched along the
// line from ray to ray, start + s (end - start), cut to the ends: so every direction tried is one of the pyramid's, and
// a rounded s costs a second-order part of u·p only.
Sight sight_of(const Point3<double>& p, const ShellPiece& tile) {
  const Point3<double> corners[4] = {
      {tile.x0, tile.y0, -1.0}, {tile.x1, tile.y0, -1.0}, {tile.x1, tile.y1, -1.0}, {tile.x0, tile.y1, -1.0}};
  const double depth = -p.z, size = length(p);
  if (depth >= 0.0 && tile.x0 * depth <= p.x && p.x <= tile.x1 * depth && tile.y0 * depth <= p.y &&
      p.y <= tile.y1 * depth)
    return {size, 0.0};
  Sight sight{-2.0 * size, 0.0};
  const auto take = [&](const Point3<double>& direction) {
    const Point3<double> u = (1.0 / length(direction)) * direction;
    const double along = dot(u, p);
    if (along > sight.along) sight = {along, length(p - along * u)};
  };
  for (std::size_t i = 0; i < 4; ++i) {
    const Point3<double>&start = corners[i], step = corners[(i + 1) % 4] - start;
    take(start);
    const double start_p = dot(start, p), step_p = dot(step, p), mixed = dot(start, step);
    const double s = (start_p * mixed - step_p * dot(start, start)) / (step_p * mixed - start_p * dot(step, step));
    if (s > 0.0 && s < 1.0) take(start + s * step);
  }
  return sight;
}

double tolerance_of(const Volume<double>& volume) {
  return Precision<double>::tolerance() * (length(volume.apex) + volume.range);
}

DistanceInterval ball_distances(const Volume<double>& volume, const ShellPiece& tile) {
  const Sight sight = sight_of(volume.apex, tile);
  const double larger = volume.range + tolerance_of(volume), smaller = volume.range - tolerance_of(volume);
  if (sight.aside > larger) return {};
  const double outer = std::sqrt((larger - sight.aside) * (larger + sight.aside));
  DistanceInterval interval{std::max(0.0, sight.along - outer), sight.along + outer, 1.0, 0.0};
  if (sight.aside >= smaller) return interval;
  const double inner = std::sqrt((smaller - sight.aside) * (smaller + sight.aside));
  interval.inner_lo = std::max(0.0, sight.along - inner);
  interval.inner_hi = sight.along + inner;
  return interval;
}

// Is there a plane between the volume and the pyramid, cut where the volume cannot reach?
bool is_apart(const Volume<double>& volume, const ShellPiece& tile) {
  const auto depth = static_cast<float>(1.01 * (length(volume.apex) + volume.range));
  if (!std::isfinite(depth)) return false;
  const auto polytope = polytope_of<double>(FrustumPiece{tile.x0, tile.x1, tile.y0, tile.y1, 0.0f, depth, false});
  const Setting<double> setting(volume, polytope);
  return find_separation(setting).gap > setting.tolerance;
}

DistanceInterval distances(const Volume<double>& volume, const ShellPiece& tile) {
  DistanceInterval interval = ball_distances(volume, tile);
  if (!volume.is_cone || interval.outer_lo > interval.outer_hi) return interval;
  interval.inner_lo = 1.0;
  interval.inner_hi = 0.0;
  const PyramidReach<double> reach = pyramid_reach(volume, pyramid_of<double>(tile.x0, tile.x1, tile.y0, tile.y1));
  if (reach.is_beyond || (reach.is_empty && is_apart(volume, tile))) return {};
  if (reach.is_empty || !(reach.inside.margin > reach.tolerance)) return interval;
  const double near_pull = pull(reach, reach.nearest), far_pull = pull(reach, reach.farthest);
  const double inside = length(reach.inside.at);
  interval.outer_lo = std::max(interval.outer_lo, reach.lo - near_pull);
  interval.outer_hi = std::min(interval.outer_hi, reach.hi + far_pull);
  interval.inner_lo = std::min(reach.lo + near_pull, inside + reach.tolerance);
  interval.inner_hi = std::max(reach.hi - far_pull, inside - reach.tolerance);
  return interval;
}

struct Filter {
  const Volume<double>& volume;

  Verdict operator()(const FrustumPiece& cell) const { return meets_polytope(volume, polytope_of<double>(cell)); }
  Verdict operator()(const Box& cell) const { return meets_polytope(volume, polytope_of<double>(cell)); }
  Verdict operator()(const ShellPiece& cell) const {
    const double near = cell.distance0, far = cell.distance1;
    const DistanceInterval reach = distances(within(volume, far), cell);
    if (!reach.may_reach(near, far)) return Verdict::no;
    return reach.surely_reaches(near, far) ? Verdict::yes : Verdict::open;
  }
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
  return std::visit(Filter{volume_}, cell);
}

DistanceInterval LightFilter::distances(const ShellPiece& tile) const {
  constexpr double k_infinity = std::numeric_limits<double>::infinity();
  if (std::isinf(volume_.range)) return {0.0, k_infinity, 1.0, 0.0};  // each shell on its own
  return geom::distances(volume_, tile);
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
