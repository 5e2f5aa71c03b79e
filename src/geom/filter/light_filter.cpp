#include "geom/filter/light_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/numbers/point3.h"
#include "geom/numbers/precision.h"
#include "geom/search/common_point.h"
#include "geom/search/eye_distances.h"
#include "geom/search/separating_plane.h"
#include "geom/shapes/light_volume.h"
#include "geom/shapes/polytope.h"

namespace clusterbench::geom {
namespace {

// Every answer of the filter has evidence: a yes has a point that is in cell and volume by more than the tolerance, a
// no has a plane or (shells) a distance that leaves more than the tolerance between them. Only the measurement of that
// evidence has to be precise enough; the source and the precision of a candidate do not matter.
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
//   50 u S  distance of a ball's centre from a shell cell: a face's normal 5 u S, one between two faces' 10 u S, the
//           part along it 13 u S, the part across it 22 u S; or 2^11 u S where a direction of the pyramid proves itself
//   95 u S  gap of a plane beside a polytope around a shell cell, whose corners are off by 12 u S: 80 u S as above and
//           these
// Under 2^7 u S = 2^-46 S, and 2^-41 S for balls and shells: 8 times less than the tolerance and more. Example: a spot
// of 10 m, 50 m from the eye, and a cell up to 60 m from it: S = 120 m, the tolerance is 4e-10 m, and the measuring
// error is below 2e-12 m.
//
// Distances of spots from the eye: the inner interval is proven by points (pull() is the distance by which a candidate
// that may lie outside by the tolerance has to move to be in the set for certain), the outer one by the ball's
// distances and by planes. Candidates without proof only guide the search; a "no" that relied on them would be wrong if
// rounding had lost one (test: FilterOnMaps.lights_that_a_cell_touches_or_misses_are_never_contradicted).

// A corner well inside the volume decides most pairs, a plane along the cone's side most of the others.
Verdict corners_decide(const Volume<double>& volume, const Polytope<double>& cell, double tolerance) {
  Point3<double> sum{0.0, 0.0, 0.0};
  const double safe_range = volume.range - tolerance;
  for (const Point3<double>& corner : cell.corners) {
    const Point3<double> v = corner - volume.apex;
    if (safe_range > 0.0 && dot(v, v) < safe_range * safe_range && volume.side_margin(corner) > tolerance)
      return Verdict::yes;
    sum = sum + v;
  }
  const Point3<double> outward = volume.cos_angle * unit_across(volume.axis, sum) -
                                 volume.sin_angle * volume.axis;  // normal of a plane along the cone's side
  for (const Point3<double>& corner : cell.corners)
    if (dot(outward, corner - volume.apex) <= tolerance) return Verdict::uncertain;
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

// The parameters of the nearest points of two segments (start + t step, 0 <= t <= 1), approximately.
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

// Tests two points that are often well inside both sets: the middle of the axis's part in the cell; and the point where
// the line from the axis to the cell's middle line, between their nearest points, has just entered the cell.
bool meet_near_axis(const Volume<double>& volume, const Polytope<double>& cell, double tolerance) {
  const auto is_common = [&](const Point3<double>& p) { return witness_at(volume, cell.faces, p).margin > tolerance; };
  const Stretch along = stretch_within(cell, volume.apex, volume.axis, {0.0, volume.range});
  if (along.from < along.to && is_common(volume.apex + ((along.from + along.to) / 2.0) * volume.axis)) return true;
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
  return is_common(start + (entry + k_further * (1.0 - entry)) * step);
}

Verdict meets_polytope(const Volume<double>& unlimited, const Polytope<double>& cell) {
  const Setting<double> setting(unlimited, cell);
  const Volume<double>& volume = setting.volume;
  const Reached<6> reached = reached_faces(volume, cell.faces, setting.tolerance);
  if (reached.is_beyond) return Verdict::no;
  if (volume.is_cone) {
    const Verdict verdict = corners_decide(volume, cell, setting.tolerance);
    if (verdict != Verdict::uncertain) return verdict;
    Separator<double> separator(volume, cell);
    separator.try_likely_tangents();
    if (separator.best().gap > setting.tolerance) return Verdict::no;
    if (meet_near_axis(volume, cell, setting.tolerance)) return Verdict::yes;
  }
  const Witness<double> witness = setting.common_point(reached.faces);
  if (witness.margin > setting.tolerance) return Verdict::yes;
  const bool may_be_apart = witness.margin < 0.0;
  return may_be_apart && find_separation(setting).gap > setting.tolerance ? Verdict::no : Verdict::uncertain;
}

// A point relative to a pyramid: for t >= 0 from the eye, the pyramid's points are at least sqrt((t - along)² +
// height²) away from it (`bound`, proven by a half-space that contains the pyramid), or one of them is exactly that far
// away (`attained`, in a tested direction). In exact numbers both are the same (rational_cell.cpp).
struct Part {
  double along, height;
};
struct Sight {
  Part bound, attained;
};

std::array<Point3<double>, 4> tile_rays(const ShellCell& tile) {
  return {Point3<double>{tile.x0, tile.y0, -1.0},
          {tile.x1, tile.y0, -1.0},
          {tile.x1, tile.y1, -1.0},
          {tile.x0, tile.y1, -1.0}};
}

// A direction of the pyramid, and the component of the vector to p across it.
struct Tried {
  Part part;
  Point3<double> across;
};

// The nearest of some directions: the four rays, and on each face the point along the line from ray to ray, start + s
// (end - start), that leans most towards p. As s is clamped to the ends, the direction is one of the pyramid's even if
// s is rounded.
Tried nearest_direction(const Point3<double>& p, const std::array<Point3<double>, 4>& rays) {
  Tried best{{-2.0 * length(p), 0.0}, {0.0, 0.0, 0.0}};
  const auto consider = [&](const Point3<double>& direction) {
    const Point3<double> u = (1.0 / length(direction)) * direction;
    const double along = dot(u, p);
    const Point3<double> across = p - along * u;
    const double height = length(across);
    // In front, compare the height: in `along`, rounding hides small differences.
    if (along > 0.0 && best.part.along > 0.0 ? height < best.part.height : along > best.part.along)
      best = {{along, height}, across};
  };
  for (std::size_t i = 0; i < 4; ++i) {
    const Point3<double>&start = rays[i], step = rays[(i + 1) % 4] - start;
    consider(start);
    const double start_p = dot(start, p), step_p = dot(step, p), mixed = dot(start, step);
    const double s = (start_p * mixed - step_p * dot(start, start)) / (step_p * mixed - start_p * dot(step, step));
    if (s > 0.0 && s < 1.0) consider(start + s * step);
  }
  return best;
}

// The best bound from half-spaces through the eye: those of the four faces, and for each two neighbouring faces the
// half-space that faces p from their common ray. A normal that is a sum of both faces' normals with weights that are
// not negative has the pyramid behind it, even if the weights are rounded.
Part farthest_behind(const Point3<double>& p, const ShellCell& tile) {
  const std::array<HalfSpace<double>, 4> faces = slope_planes<double>(tile.x0, tile.x1, tile.y0, tile.y1);
  Part best{length(p), 0.0};
  const auto consider = [&](const Point3<double>& normal) {
    const double height = dot(normal, p);
    if (height > best.height) best = {length(p - height * normal), height};
  };
  for (const std::size_t x : {0u, 1u})
    for (const std::size_t y : {2u, 3u}) {
      const Point3<double>&n1 = faces[x].normal, &n2 = faces[y].normal;
      consider(n1);
      consider(n2);
      // Weights of both normals from p's components along them.
      const double mixed = dot(n1, n2), part1 = dot(n1, p), part2 = dot(n2, p);
      const double weight1 = part1 - mixed * part2, weight2 = part2 - mixed * part1;
      if (!(weight1 > 0.0 && weight2 > 0.0)) continue;
      const Point3<double> sum = weight1 * n1 + weight2 * n2;
      consider((1.0 / length(sum)) * sum);
    }
  return best;
}

// Does the tested direction prove the bound itself? In front: yes if the half-space across the vector from it to the
// point contains all four rays; an error of 2^-42 in this makes points at distance t from the eye nearer by 2^-42 t at
// most. Behind: yes if all rays lean away from p: any direction is a sum of the four (of unit length) with weights that
// add to 1 at least, so it leans away no less than the ray that leans away least.
bool is_behind(const std::array<Point3<double>, 4>& rays, const Part& nearest, const Point3<double>& across) {
  if (nearest.along < 0.0) return true;
  return std::all_of(rays.begin(), rays.end(), [&](const Point3<double>& ray) {
    return dot(across, ray) <= 0x1p-43 * nearest.height * (std::abs(ray.x) + std::abs(ray.y) + 1.0);
  });
}

Sight sight_of(const Point3<double>& p, const ShellCell& tile) {
  const double depth = -p.z, size = length(p);
  if (depth >= 0.0 && tile.x0 * depth <= p.x && p.x <= tile.x1 * depth && tile.y0 * depth <= p.y &&
      p.y <= tile.y1 * depth)
    return {{size, 0.0}, {size, 0.0}};
  const std::array<Point3<double>, 4> rays = tile_rays(tile);
  const auto [attained, across] = nearest_direction(p, rays);
  return {is_behind(rays, attained, across) ? attained : farthest_behind(p, tile), attained};
}

double tolerance_of(const Volume<double>& volume) {
  return Precision<double>::tolerance() * (length(volume.apex) + volume.range);
}

DistanceInterval ball_distances(const Volume<double>& volume, const ShellCell& tile) {
  const auto [bound, attained] = sight_of(volume.apex, tile);
  const double larger = volume.range + tolerance_of(volume), smaller = volume.range - tolerance_of(volume);
  if (bound.height > larger) return {};
  const double outer = std::sqrt((larger - bound.height) * (larger + bound.height));
  DistanceInterval interval;
  interval.outer_lo = interval.likely_lo = std::max(0.0, bound.along - outer);
  interval.outer_hi = interval.likely_hi = bound.along + outer;
  if (attained.height >= smaller) return interval;
  const double inner = std::sqrt((smaller - attained.height) * (smaller + attained.height));
  interval.inner_lo = std::max(0.0, attained.along - inner);
  interval.inner_hi = attained.along + inner;
  return interval;
}

// The part of the pyramid between two planes that contains the shell cell. The planes are across a direction u in the
// pyramid's middle: one at the far shell's greatest extent along u, one at the near shell's least extent, which is at
// the rays. (Of all directions of the pyramid the rays lean from u most.)
Polytope<double> polytope_around(const ShellCell& shell) {
  const Pyramid<double> pyramid = pyramid_of<double>(shell.x0, shell.x1, shell.y0, shell.y1);
  Mean<double> mean;
  for (const Point3<double>& ray : pyramid.rays) mean.add(ray);
  const Point3<double> u = (1.0 / length(mean.at())) * mean.at();
  double cosine = 1.0;
  for (const Point3<double>& ray : pyramid.rays) cosine = std::min(cosine, dot(ray, u));
  Polytope<double> cell;
  for (std::size_t i = 0; i < 4; ++i) cell.faces[i] = pyramid.faces[i];
  const double near = shell.distance0 * cosine, far = shell.distance1;
  cell.faces[4] = {-1.0 * u, -near};
  cell.faces[5] = {u, far};
  for (std::size_t i = 0; i < 4; ++i) {
    const double lean = dot(pyramid.rays[i], u);
    cell.corners[i] = (near / lean) * pyramid.rays[i];
    cell.corners[i + 4] = (far / lean) * pyramid.rays[i];
  }
  return cell;
}

// Is there a plane between the volume and the shell cell, or planes between the volume and each of the cell's parts?
// The bounding planes ignore the cell's curvature; a part of half the width and height has a quarter of it.
bool is_apart(const Volume<double>& volume, const ShellCell& shell, int splits) {
  const Polytope<double> polytope = polytope_around(shell);
  const Setting<double> setting(volume, polytope);
  if (reached_faces(setting.volume, polytope.faces, setting.tolerance).is_beyond) return true;
  if (find_separation(setting).gap > setting.tolerance) return true;
  if (splits == 0) return false;
  const float x = 0.5f * (shell.x0 + shell.x1), y = 0.5f * (shell.y0 + shell.y1);
  for (const auto& [x0, x1] : {std::pair(shell.x0, x), std::pair(x, shell.x1)})
    for (const auto& [y0, y1] : {std::pair(shell.y0, y), std::pair(y, shell.y1)})
      if (!is_apart(volume, {x0, x1, y0, y1, shell.distance0, shell.distance1}, splits - 1)) return false;
  return true;
}
constexpr int k_splits = 3;

DistanceInterval distances(const Volume<double>& volume, const ShellCell& tile) {
  DistanceInterval interval = ball_distances(volume, tile);
  if (!volume.is_cone || interval.outer_lo > interval.outer_hi) return interval;
  interval.inner_lo = 1.0;
  interval.inner_hi = 0.0;
  const PyramidReach<double> reach = pyramid_reach(volume, pyramid_of<double>(tile.x0, tile.x1, tile.y0, tile.y1));
  if (reach.is_beyond) return {};
  if (reach.is_empty) {
    const auto beyond = static_cast<float>(interval.outer_hi);
    const float end = std::nextafter(beyond, std::numeric_limits<float>::infinity());
    return is_apart(volume, {tile.x0, tile.x1, tile.y0, tile.y1, 0.0f, end}, 0) ? DistanceInterval{} : interval;
  }
  if (!(reach.inside.margin > reach.tolerance)) return interval;
  const double near_pull = pull(reach, reach.nearest), far_pull = pull(reach, reach.farthest);
  const double inside = length(reach.inside.at);
  interval.likely_lo = std::max(interval.outer_lo, reach.lo - near_pull);
  interval.likely_hi = std::min(interval.outer_hi, reach.hi + far_pull);
  interval.inner_lo = std::min(reach.lo + near_pull, inside + reach.tolerance);
  interval.inner_hi = std::max(reach.hi - far_pull, inside - reach.tolerance);
  return interval;
}

struct Filter {
  const Volume<double>& volume;

  Verdict operator()(const FrustumCell& cell) const { return meets_polytope(volume, polytope_of<double>(cell)); }
  Verdict operator()(const Box& cell) const { return meets_polytope(volume, polytope_of<double>(cell)); }
  Verdict operator()(const ShellCell& cell) const {
    const double near = cell.distance0, far = cell.distance1;
    const Volume<double> limited = within(volume, far);
    const DistanceInterval reach = distances(limited, cell);
    if (!reach.may_reach(near, far)) return Verdict::no;
    if (reach.surely_reaches(near, far)) return Verdict::yes;
    return !reach.likely_reaches(near, far) && is_apart(limited, cell, k_splits) ? Verdict::no : Verdict::uncertain;
  }
};

struct ShapeOf {
  using Shape = std::variant<Volume<double>, BoxDecider>;

  template <class Light>
  Shape operator()(const Light& light) const {
    return volume_of<double>(light);
  }
  Shape operator()(const BoxVolume& box) const { return BoxDecider(box); }
};

}  // namespace

LightFilter::LightFilter(const LightVolume& light) : shape_(std::visit(ShapeOf{}, light)) {}

Verdict LightFilter::meets(const Cell& cell) const {
  if (const auto* box = std::get_if<BoxDecider>(&shape_)) return box->meets_quickly(cell);
  return std::visit(Filter{volume()}, cell);
}

DistanceInterval LightFilter::distances(const ShellCell& tile) const {
  return geom::distances(within(volume(), double{tile.distance1}), tile);
}

bool LightFilter::is_surely_apart(const ShellCell& shell) const {
  return is_apart(within(volume(), double{shell.distance1}), shell, k_splits);
}

Verdict filter_meets(const LightVolume& light, const Cell& cell) {
  return LightFilter(light).meets(cell);
}

}  // namespace clusterbench::geom
