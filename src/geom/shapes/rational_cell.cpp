#include "geom/shapes/rational_cell.h"

#include <algorithm>

namespace clusterbench::geom {
namespace {

Rational clamped(const Rational& value, const Rational& lo, const Rational& hi) {
  if (value < lo) return lo;
  return value > hi ? hi : value;
}

// Between tile planes and two depths: x between x[0]*depth and x[1]*depth, likewise y; depth between depth[0] and
// depth[1].
struct Slab {
  std::array<Rational, 2> x, y, depth;
};

// One coordinate of a point of a face, edge or corner: either free, or slope * depth with the chosen slope.
struct Tied {
  bool free;
  Rational slope;
};

// The depth of the point nearest to c among those with x and y tied as given and depth free: the projection onto the
// line or plane {(slope_x * depth, slope_y * depth, depth)}; free coordinates have the centre's own value.
Rational nearest_depth(const RationalPoint& c, const Tied& x, const Tied& y) {
  Rational numerator = -c.z, denominator = 1;
  if (!x.free) {
    numerator += x.slope * c.x;
    denominator += squared(x.slope);
  }
  if (!y.free) {
    numerator += y.slope * c.y;
    denominator += squared(y.slope);
  }
  return numerator / denominator;
}

bool within(const Rational& value, const std::array<Rational, 2>& slopes, const Rational& depth) {
  return slopes[0] * depth <= value && value <= slopes[1] * depth;
}

Tied tied(const std::array<Rational, 2>& slopes, int choice) {
  return choice < 2 ? Tied{false, slopes[static_cast<std::size_t>(choice)]} : Tied{true, 0};
}

// The nearest point: `nearest`, or one of the centre's projections onto the spans of faces, edges and corners, and the
// inside (three choices per pair of planes: low, high, free), if it lies in the slab. first_choice 0: all projections;
// 18: only those with free depth.
RationalPoint nearest_projection(const RationalPoint& c, const Slab& slab, int first_choice, RationalPoint nearest) {
  for (int choice = first_choice; choice < 27; ++choice) {
    const Tied x = tied(slab.x, choice % 3), y = tied(slab.y, choice / 3 % 3);
    const std::size_t end = static_cast<std::size_t>(choice / 9);
    const Rational depth = end < 2 ? slab.depth[end] : nearest_depth(c, x, y);
    if (depth < slab.depth[0] || depth > slab.depth[1]) continue;
    const RationalPoint p{x.free ? c.x : x.slope * depth, y.free ? c.y : y.slope * depth, -depth};
    if (!within(p.x, slab.x, depth) || !within(p.y, slab.y, depth)) continue;
    if (squared_distance(c, p) < squared_distance(c, nearest)) nearest = p;
  }
  return nearest;
}

RationalPoint nearest_in_pyramid(const ShellCell& cell, const RationalPoint& c) {
  // The nearest point of a convex cone is no farther from its apex than the centre is.
  const Rational deepest = norm_1(c) + 1;
  const Slab pyramid{{exact(cell.x0), exact(cell.x1)}, {exact(cell.y0), exact(cell.y1)}, {0, deepest}};
  return nearest_projection(c, pyramid, 18, {0, 0, 0});
}

Box box_of(const FrustumCell& orthographic) {
  return {{orthographic.x0, orthographic.y0, -orthographic.depth1},
          {orthographic.x1, orthographic.y1, -orthographic.depth0}};
}

struct PlanesOf {
  // depth = -z: x <= x1 * depth is x + x1 * z <= 0.
  static Planes of_pyramid(float x0, float x1, float y0, float y1) {
    return {{{-1, 0, -exact(x0)}, 0}, {{1, 0, exact(x1)}, 0}, {{0, -1, -exact(y0)}, 0}, {{0, 1, exact(y1)}, 0}};
  }

  Planes operator()(const Box& cell) const {
    return {{{-1, 0, 0}, -exact(cell.lo.x)}, {{1, 0, 0}, exact(cell.hi.x)},   {{0, -1, 0}, -exact(cell.lo.y)},
            {{0, 1, 0}, exact(cell.hi.y)},   {{0, 0, -1}, -exact(cell.lo.z)}, {{0, 0, 1}, exact(cell.hi.z)}};
  }
  Planes operator()(const FrustumCell& cell) const {
    if (cell.orthographic) return (*this)(box_of(cell));
    Planes planes = of_pyramid(cell.x0, cell.x1, cell.y0, cell.y1);
    planes.push_back({{0, 0, 1}, -exact(cell.depth0)});
    planes.push_back({{0, 0, -1}, exact(cell.depth1)});
    return planes;
  }
  Planes operator()(const ShellCell& cell) const {
    Planes planes = of_pyramid(cell.x0, cell.x1, cell.y0, cell.y1);
    planes.push_back({{0, 0, 1}, 0});
    return planes;
  }
};

// a·c / |a| < b·c / |b| for non-zero a and b, both sides not positive.
bool leans_away_more(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c) {
  return squared(dot(a, c)) * dot(b, b) > squared(dot(b, c)) * dot(a, a);
}

}  // namespace

Planes planes_of(const Cell& cell) {
  return std::visit(PlanesOf{}, cell);
}

bool all_hold(const Planes& planes, const RationalPoint& p) {
  return std::all_of(planes.begin(), planes.end(),
                     [&](const HalfSpace<Rational>& plane) { return plane.margin(p).sign() >= 0; });
}

bool holds(const Cell& cell, const RationalPoint& p) {
  if (!all_hold(planes_of(cell), p)) return false;
  const ShellCell* shell = std::get_if<ShellCell>(&cell);
  if (shell == nullptr) return true;
  const Rational square = dot(p, p);
  return squared(exact(shell->distance0)) <= square && square <= squared(exact(shell->distance1));
}

std::optional<Span> span_within(const Planes& planes, const RationalPoint& start, const RationalPoint& step) {
  Span span{0, std::nullopt};
  for (const HalfSpace<Rational>& plane : planes) {
    const Rational slope = dot(plane.normal, step), margin = plane.margin(start);
    if (slope.sign() == 0) {
      if (margin.sign() < 0) return std::nullopt;
      continue;
    }
    const Rational t = margin / slope;
    if (slope.sign() < 0)
      span.from = std::max(span.from, t);
    else if (!span.to || t < *span.to)
      span.to = t;
  }
  if (span.to && *span.to < span.from) return std::nullopt;
  return span;
}

std::array<RationalPoint, 8> corners_of(const Box& cell) {
  std::array<RationalPoint, 8> corners;
  for (unsigned i = 0; i < 8; ++i)
    corners[i] = {exact((i & 1) != 0 ? cell.hi.x : cell.lo.x), exact((i & 2) != 0 ? cell.hi.y : cell.lo.y),
                  exact((i & 4) != 0 ? cell.lo.z : cell.hi.z)};
  return corners;
}

std::array<RationalPoint, 8> corners_of(const FrustumCell& cell) {
  if (cell.orthographic) return corners_of(box_of(cell));
  std::array<RationalPoint, 8> corners;
  for (unsigned i = 0; i < 8; ++i) {
    const Rational depth = exact((i & 4) != 0 ? cell.depth1 : cell.depth0);
    corners[i] = {exact((i & 1) != 0 ? cell.x1 : cell.x0) * depth, exact((i & 2) != 0 ? cell.y1 : cell.y0) * depth,
                  -depth};
  }
  return corners;
}

std::array<RationalPoint, 4> rays_of(const ShellCell& cell) {
  std::array<RationalPoint, 4> rays;
  for (unsigned i = 0; i < 4; ++i)
    rays[i] = {exact((i & 1) != 0 ? cell.x1 : cell.x0), exact((i & 2) != 0 ? cell.y1 : cell.y0), -1};
  return rays;
}

RationalPoint nearest_point(const Box& cell, const RationalPoint& p) {
  return {clamped(p.x, exact(cell.lo.x), exact(cell.hi.x)), clamped(p.y, exact(cell.lo.y), exact(cell.hi.y)),
          clamped(p.z, exact(cell.lo.z), exact(cell.hi.z))};
}

RationalPoint nearest_point(const FrustumCell& cell, const RationalPoint& p) {
  if (cell.orthographic) return nearest_point(box_of(cell), p);
  const Slab slab{
      {exact(cell.x0), exact(cell.x1)}, {exact(cell.y0), exact(cell.y1)}, {exact(cell.depth0), exact(cell.depth1)}};
  return nearest_projection(p, slab, 0, corners_of(cell)[0]);
}

// The squared distance from p to t * u (u of unit length) is t² - 2 t (u·p) + |p|². For every t the best u has the
// largest u·p, and then the best t is u·p, clamped between the shells. If the pyramid's point nearest to p, q, is not
// the eye, u = q/|q|, as u·p <= |q| for every u of the pyramid (the pyramid is convex, and p - q is perpendicular to q
// and points away from it). If it is the eye, u·p <= 0 everywhere. Then u is a sum of the four rays (each taken of unit
// length) with weights that add to 1 at least, and one of these rays leans no less towards p than u.
NearestOnShells nearest_point(const ShellCell& cell, const RationalPoint& p) {
  RationalPoint towards = nearest_in_pyramid(cell, p);
  if (dot(towards, towards) == 0) {
    const std::array<RationalPoint, 4> rays = rays_of(cell);
    towards = rays[0];
    for (const RationalPoint& ray : rays)
      if (leans_away_more(towards, ray, p)) towards = ray;
    return {towards, exact(cell.distance0)};
  }
  // Here u·p = |towards|.
  const Rational square = dot(towards, towards);
  if (square < squared(exact(cell.distance0))) return {towards, exact(cell.distance0)};
  if (square > squared(exact(cell.distance1))) return {towards, exact(cell.distance1)};
  return {towards, std::nullopt};
}

bool reaches(const RationalPoint& p, const Rational& reach, const NearestOnShells& nearest) {
  if (!nearest.distance) return squared_distance(p, nearest.towards) <= squared(reach);
  // t² - 2 t (v·p) / |v| + |p|² <= reach², times |v|².
  const Rational &t = *nearest.distance, size = dot(nearest.towards, nearest.towards);
  return at_most_root((squared(t) + dot(p, p) - squared(reach)) * size, 2 * t * dot(nearest.towards, p), size);
}

}  // namespace clusterbench::geom
