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

// What the filter says is said with evidence: a yes with a point that is in cell and volume by more than the tolerance,
// a no with a plane or (shells) a distance that leaves more than the tolerance between them. Only measuring that
// evidence has to be exact enough; where a candidate came from, and how badly it was placed, does not matter.
//
// The tolerance is 2^-38 S, S = |apex| + range + the cell's largest distance from the origin. With u = 2^-53, and sine
// and cosine of the half-angle right to 2 u, measuring is off by at most:
//    7 u S  apex: a difference, three products and two sums per coordinate, three coordinates
//    0      corners: products of two floats, 48 bits, are exact in 53
//   11 u    axis: 5 u as for the apex, 6 u from making it a unit vector
//    5 u    a face's unit normal
//   13 u S  how far a point is from a face (5 u S normal, 3 u S scalar product, 1 u S difference), or from the sphere
//           (7 u S apex, 1 u S difference, 3 u S length, 1 u S difference)
//   80 u S  how far it is from the cone's side: part along the axis 7 + 1 + 3 + 11 = 22 u S, part across it
//           22 + 11 + 8 + 4 = 45 u S, both times sine and cosine and taken from each other 13 u S
//   80 u S  gap of a plane: corners along its normal 8 + 3 + 4 = 15 u S, the volume's extent along it 18 u S along the
//           axis, 35 u S across it, 12 u S for the rest
//  115 u S  a plane along the cone's side whose extent is taken to be 0: 60 u of the direction across the axis
//           (unit_across loses at most a factor of 10), 11 u of the axis and 29 u for the rest, and 15 u S as above
//   45 u S  distance of a ball's centre from a shell piece: 15 u S for the part along the nearest direction, 30 u S for
//           the part aside. A direction on a face that is off by an angle e costs |q| e² / 2 of the part along (q: the
//           centre's projection onto the face). e is below 10 u |apex| / |q| (and 3), so that is below 10 u S.
// Under 2^7 u S = 2^-46 S in all: 256 times less than the tolerance.
//
// Distances of spots from the eye are the one exception: an inner interval is proven by points, an outer one rests on
// the places of the extremes. pull() is what they can move by if all surfaces do by the tolerance: in proportion to how
// thin the set is (a tangent plane cuts a thin set, whose places are good to half the digits). Where the set is thinner
// than the tolerance, the ball's interval stands in.

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

// The part of a line, start + t step with from <= t <= to, that is in the cell.
struct Stretch {
  double from, to;
};
Stretch stretch_within(const Polytope<double>& cell, const Point3<double>& start, const Point3<double>& step,
                       Stretch stretch) {
  for (const HalfSpace<double>& face : cell.faces) {
    const double margin = face.margin(start), lean = dot(face.normal, step);
    if (lean > 0.0) stretch.to = std::min(stretch.to, margin / lean);
    if (lean < 0.0) stretch.from = std::max(stretch.from, margin / lean);
    if (lean == 0.0 && margin < 0.0) return {1.0, 0.0};
  }
  return stretch;
}

// Of two segments (length 1 each: start + t step, 0 <= t <= 1), about the places that are nearest to each other.
struct Nearest {
  double first, second;
};
Nearest nearest_of_segments(const Point3<double>& start1, const Point3<double>& step1, const Point3<double>& start2,
                            const Point3<double>& step2) {
  const Point3<double> between = start1 - start2;
  const double a = dot(step1, step1), b = dot(step1, step2), c = dot(step2, step2), d = dot(step1, between),
               e = dot(step2, between), square = a * c - b * b;
  const double free = square > 0.0 ? std::clamp((b * e - c * d) / square, 0.0, 1.0) : 0.0;
  const double second = c > 0.0 ? std::clamp((b * free + e) / c, 0.0, 1.0) : 0.0;
  return {a > 0.0 ? std::clamp((b * second - d) / a, 0.0, 1.0) : 0.0, second};
}

// Two points that are often well inside both: the middle of the axis in the cell, and where the way from the axis to
// the cell's own middle line, where these are nearest to each other, has just entered the cell.
Verdict axis_settles(const Volume<double>& volume, const Polytope<double>& cell, double tolerance) {
  const auto is_common = [&](const Point3<double>& p) { return witness_at(volume, cell.faces, p).margin > tolerance; };
  const Stretch along = stretch_within(cell, volume.apex, volume.axis, {0.0, volume.range});
  if (along.from < along.to && is_common(volume.apex + ((along.from + along.to) / 2.0) * volume.axis))
    return Verdict::yes;
  Mean<double> front, back;
  for (std::size_t i = 0; i < 4; ++i) {
    front.add(cell.corners[i]);
    back.add(cell.corners[i + 4]);
  }
  const Point3<double> axis = volume.range * volume.axis, line = back.at() - front.at();
  const Nearest nearest = nearest_of_segments(volume.apex, axis, front.at(), line);
  const Point3<double> start = volume.apex + nearest.first * axis;
  const Point3<double> step = front.at() + nearest.second * line - start;
  const double entry = stretch_within(cell, start, step, {0.0, 1.0}).from;
  constexpr double k_further = 0.05;
  return is_common(start + (entry + k_further * (1.0 - entry)) * step) ? Verdict::yes : Verdict::open;
}

Verdict meets_polytope(const Volume<double>& unlimited, const Polytope<double>& cell) {
  const Setting<double> setting(unlimited, cell);
  const Volume<double>& volume = setting.volume;
  const Reached<6> reached = reached_faces(volume, cell.faces, setting.tolerance);
  if (reached.is_beyond) return Verdict::no;
  if (volume.is_cone) {
    Verdict verdict = corners_settle(volume, cell, setting.tolerance);
    if (verdict == Verdict::open) verdict = axis_settles(volume, cell, setting.tolerance);
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
