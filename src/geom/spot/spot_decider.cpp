#include "geom/spot/spot_decider.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geom/certificate/exact_axis.h"
#include "geom/search/gjk.h"
#include "geom/spot/proof_by_search.h"

namespace clusterbench::geom {
namespace {

using Point = Point3<double>;
using BoundedPoint = Point3<Bounded>;

// The relative size that a search in doubles treats as 0. Every result of the search is proven, so this only has to be
// more than rounding.
constexpr double k_near_zero = 0x1p-40;

BoundedPoint exactly(const Point& p) {
  return {p.x, p.y, p.z};
}
Point about(const BoundedPoint& p) {
  return {p.x.value, p.y.value, p.z.value};
}
Bounded least_of(const Bounded& a, const Bounded& b) {
  return -larger_of(-a, -b);
}

BoundedPoint widened(BoundedPoint p, double by) {
  if (by == 0.0) return p;
  for (Bounded* part : {&p.x, &p.y, &p.z}) part->error = bounded::rounded_up(part->error + by);
  return p;
}

BoundedPoint turned(const Mat3d& rotation, const Vec3d& v) {
  const auto row = [&](int i) {
    return Bounded(rotation[0][i]) * v.x + Bounded(rotation[1][i]) * v.y + Bounded(rotation[2][i]) * v.z;
  };
  return {row(0), row(1), row(2)};
}

// The library's sines and cosines are right to 2 unit roundoffs, see geom/filter/light_filter.cpp.
Bounded with_library_error(double value) {
  return value == 0.0 ? Bounded(0.0) : Bounded(value, bounded::rounded_up(std::abs(value) * 0x1p-51));
}

template <class PlaneCell>
std::array<BoundedPoint, 8> corners_of(const PlaneCell& cell) {
  std::array<BoundedPoint, 8> corners;
  const Corners exact = exact_corners(cell);
  for (std::size_t i = 0; i < 8; ++i) corners[i] = exactly(exact[i]);
  return corners;
}
std::array<BoundedPoint, 8> corners_of(const ShellCell& cell) {
  std::array<BoundedPoint, 8> corners;
  for (unsigned i = 0; i < 4; ++i) {
    const BoundedPoint ray{(i & 1) != 0 ? cell.x1 : cell.x0, (i & 2) != 0 ? cell.y1 : cell.y0, -1.0};
    const Bounded size = sqrt(dot(ray, ray));
    corners[i] = (Bounded(cell.distance0) / size) * ray;
    corners[i + 4] = (Bounded(cell.distance1) / size) * ray;
  }
  return corners;
}

// Normals that point into the cell, tested by is(normal).
template <class Is>
bool any_slope_normal(float x0, float x1, float y0, float y1, Is&& is) {
  return is(Point{1.0, 0.0, x0}) || is(Point{-1.0, 0.0, -x1}) || is(Point{0.0, 1.0, y0}) || is(Point{0.0, -1.0, -y1});
}
template <class Is>
bool any_face_normal(const Box&, Is&& is) {
  return is(Point{1.0, 0.0, 0.0}) || is(Point{-1.0, 0.0, 0.0}) || is(Point{0.0, 1.0, 0.0}) ||
         is(Point{0.0, -1.0, 0.0}) || is(Point{0.0, 0.0, 1.0}) || is(Point{0.0, 0.0, -1.0});
}
template <class Is>
bool any_face_normal(const FrustumCell& cell, Is&& is) {
  if (cell.orthographic) return any_face_normal(Box{}, is);
  return is(Point{0.0, 0.0, 1.0}) || is(Point{0.0, 0.0, -1.0}) ||
         any_slope_normal(cell.x0, cell.x1, cell.y0, cell.y1, is);
}
// A near shell lies beyond a plane across the view direction through the least deep of its corners.
template <class Is>
bool any_face_normal(const ShellCell& cell, Is&& is) {
  return is(Point{0.0, 0.0, -1.0}) || any_slope_normal(cell.x0, cell.x1, cell.y0, cell.y1, is);
}

// The least value of normal·p over a cell.
Bounded least_over(const std::array<BoundedPoint, 8>& corners, const BoundedPoint& normal) {
  Bounded least = dot(normal, corners[0]);
  for (std::size_t i = 1; i < 8; ++i) least = least_of(least, dot(normal, corners[i]));
  return least;
}
template <class PlaneCell>
Bounded least_over(const PlaneCell&, const std::array<BoundedPoint, 8>& corners, const BoundedPoint& normal) {
  return least_over(corners, normal);
}
// The least value over t u, for t between the shells and u a direction of the pyramid: -t times the largest component
// of the opposite normal along any such u.
Bounded least_over(const ShellCell& cell, const std::array<BoundedPoint, 8>&, const BoundedPoint& normal) {
  const Bounded ahead = farthest_ahead(Bounded(-1.0) * normal, cell);
  if (ahead.is_surely_above(0.0)) return -(Bounded(cell.distance1) * ahead);
  if (ahead.is_surely_not_above(0.0)) return -(Bounded(cell.distance0) * ahead);
  return {0.0, bounded::rounded_up(cell.distance1 * (std::abs(ahead.value) + ahead.error))};
}

// Normals of the planes through the apex and an edge; corners are relative to the apex.
template <class PlaneCell, class Is>
bool any_edge_normal(const PlaneCell&, const Point&, const std::array<Point, 8>& corners, Is&& is) {
  for (unsigned corner = 0; corner < 8; ++corner)
    for (const unsigned bit : {1u, 2u, 4u})
      if ((corner & bit) == 0 && is(cross(corners[corner], corners[corner | bit] - corners[corner]))) return true;
  return false;
}
// Edges from shell to shell lie on rays. If the apex is beyond the far shell, a plane across the vector to the eye has
// the whole far shell behind it.
template <class Is>
bool any_edge_normal(const ShellCell& cell, const Point& apex, const std::array<Point, 8>&, Is&& is) {
  if (is(-1.0 * apex)) return true;
  for (const float x : {cell.x0, cell.x1})
    for (const float y : {cell.y0, cell.y1})
      if (is(cross(apex, Point{x, y, -1.0}))) return true;
  return false;
}

Point least_corner(const std::array<Point, 8>& corners, const Point& n) {
  return *std::min_element(corners.begin(), corners.end(),
                           [&](const Point& a, const Point& b) { return dot(n, a) < dot(n, b); });
}
// The cell's point where n·p is least, approximately; like the corners, relative to the apex.
template <class PlaneCell>
Point least_point(const PlaneCell&, const Point&, const std::array<Point, 8>& corners, const Point& n) {
  return least_corner(corners, n);
}
Point least_point(const ShellCell& cell, const Point& apex, const std::array<Point, 8>& corners, const Point& n) {
  const Point ahead = about(foot_on_pyramid(Bounded(-1.0) * exactly(n), cell));
  const double size = length(ahead);
  return size > 0.0 ? (cell.distance1 / size) * ahead - apex : least_corner(corners, n);
}

// The point of the volume where n·p is largest, relative to its apex; unit axis.
Point farthest_of_volume(const Point& n, const Point& axis, double range, double cosine, double sine) {
  const double size = length(n);
  if (!(size > 0.0)) return {0.0, 0.0, 0.0};
  const double along = dot(n, axis);
  if (along >= cosine * size) return (range / size) * n;
  const Point across = n - along * axis;
  const double size_across = length(across);
  if (!(size_across > 0.0) || cosine * along + sine * size_across <= 0.0) return {0.0, 0.0, 0.0};
  return (range * cosine) * axis + (range * sine / size_across) * across;
}

}  // namespace

SpotDecider::SpotDecider(const SpotVolume& light)
    : light_(light),
      ball_(light.apex, std::isinf(light.range) ? 0.0 : light.range),
      apex_(light.apex, 0.0),
      axis_(turned(light.apex.rotation, light.direction)),
      axis_square_(dot(axis_, axis_)) {
  const double half_angle = std::min(light.half_angle_rad, std::numbers::pi / 2.0);
  cosine_ = with_library_error(std::cos(half_angle));
  sine_ = with_library_error(std::sin(half_angle));
}

Verdict SpotDecider::leans(const BoundedPoint& way) const {
  const Bounded along = dot(way, axis_);
  const BoundedPoint across = cross(way, axis_);
  const Bounded inside = squared(sine_ * along), outside = squared(cosine_) * dot(across, across);
  if (along.is_surely_above(0.0) && (inside - outside).is_surely_above(0.0)) return Verdict::yes;
  // No half-angle is exactly 90°: in doubles it is less.
  const bool is_away = along.is_surely_not_above(0.0) || (outside - inside).is_surely_above(0.0);
  if (is_away) return dot(way, way).is_surely_above(0.0) ? Verdict::no : Verdict::uncertain;
  const bool is_exact = way.x.error == 0.0 && way.y.error == 0.0 && way.z.error == 0.0;
  return is_exact && along.is_surely_above(0.0) ? spot_106().leans(point_106(about(way))) : Verdict::uncertain;
}

const Spot106& SpotDecider::spot_106() const {
  if (!spot_106_) spot_106_.emplace(light_, 0.0);
  return *spot_106_;
}

// The extent of the volume from its apex along a unit vector w is range if w is in the cone, else range times cos(angle
// of w to the axis - half-angle), if that is positive. If the cosine is negative, the volume has only its apex in
// common with the plane through the apex.
template <class AnyCell>
bool SpotDecider::separates(const AnyCell& cell, const Point& normal_given, const Bounded& least) const {
  if ((-least).is_surely_above(0.0)) return false;
  const BoundedPoint normal = exactly(normal_given), across = cross(normal, axis_);
  const Bounded along = dot(normal, axis_), square_across = dot(across, across);
  if (leans_away(normal_given, along, square_across))
    return (-least).is_surely_not_above(0.0) || ball_.has_in_front(normal_given, cell);
  if (!least.is_surely_above(0.0) || std::isinf(light_.range)) return false;
  const bool is_outside = along.is_surely_not_above(0.0) ||
                          (squared(cosine_) * square_across - squared(sine_ * along)).is_surely_above(0.0);
  if (!is_outside) return false;
  const Bounded lean = cosine_ * along + sine_ * sqrt(square_across);
  return lean.is_surely_not_above(0.0) ||
         (squared(least) * axis_square_ - squared(Bounded(light_.range) * lean)).is_surely_above(0.0);
}

bool SpotDecider::leans_away(const Point& normal, const Bounded& along, const Bounded& square_across) const {
  if (!(-along).is_surely_above(0.0)) return false;
  const Bounded less = squared(sine_) * square_across - squared(cosine_ * along);
  if ((-less).is_surely_above(0.0)) return true;
  return !less.is_surely_above(0.0) && spot_106().surely_leans_away(point_106(normal));
}

bool SpotDecider::holds_one_of(const std::array<BoundedPoint, 8>& ways) const {
  const bool is_endless = std::isinf(light_.range);
  const Bounded square_range = Bounded(light_.range) * light_.range;
  return std::any_of(ways.begin(), ways.end(), [&](const BoundedPoint& way) {
    const Bounded square = dot(way, way);
    if (!(square.value <= square_range.value * (1.0 + k_near_zero)) || leans(way) != Verdict::yes) return false;
    return is_endless || (square - square_range).is_surely_not_above(0.0);
  });
}

// Planes through the apex first. If cone and cell have a gap, so have the cone and the cell's own cone from the apex: a
// plane that touches the latter along a corner's ray, leaning away from the axis, or along an edge, or along a face.
// All of their normals are sums of products, exact on lattices. Then planes across the shortest vector.
template <class AnyCell>
bool SpotDecider::is_separated(const AnyCell& cell, const std::array<BoundedPoint, 8>& corners,
                               const std::array<Point, 8>& ways) const {
  const BoundedPoint& apex = ball_.center();
  const Point apex_about = about(apex), axis_about = about(axis_), axis = (1.0 / length(axis_about)) * axis_about;
  const double cosine = cosine_.value, sine = sine_.value;
  double size = 0.0;
  for (const Point& way : ways) size = std::max(size, length(way));
  const double near_zero = k_near_zero * size;
  const auto is_proven = [&](const Point& normal) {
    const BoundedPoint n = exactly(normal);
    return separates(cell, normal, least_over(cell, corners, n) - dot(n, apex));
  };
  const auto is_between = [&](const Point& normal) {
    const double normal_size = length(normal);
    if (!(normal_size > 0.0)) return false;
    const Point nearest = least_corner(ways, normal);
    const double least = dot(normal, nearest) / normal_size;
    if (!(least >= -near_zero)) return false;
    const double lean = (cosine * dot(normal, axis) + sine * length(cross(normal, axis))) / normal_size;
    if (!(light_.range * lean <= least + near_zero)) return false;
    if (is_proven(normal)) return true;
    // The plane nearly touches both cone and cell: tilt it to the middle between them.
    const double distance = length(nearest);
    if (!(least < near_zero && lean < 0.0 && lean > -k_near_zero && distance > 0.0)) return false;
    return is_proven(normal - (0.5 * lean * normal_size / distance) * nearest);
  };
  if (is_between(-1.0 * axis_about) || any_face_normal(cell, is_between)) return true;
  for (const Point& way : ways)
    if (is_between(dot(way, axis_about) * way - dot(way, way) * axis_about)) return true;
  if (any_edge_normal(cell, apex_about, ways, [&](const Point& n) { return is_between(n) || is_between(-1.0 * n); }))
    return true;
  const double range = std::min(light_.range, 1.01 * size);
  const auto least = [&](const Point& n) {
    return least_point(cell, apex_about, ways, n) - farthest_of_volume(n, axis, range, cosine, sine);
  };
  return try_separating_directions(ways[0] + ways[7], least, is_proven);
}

template <class AnyCell>
Verdict SpotDecider::by_evidence(const AnyCell& cell) const {
  const std::array<BoundedPoint, 8> corners = corners_of(cell);
  std::array<BoundedPoint, 8> ways;
  std::array<Point, 8> ways_about;
  for (std::size_t i = 0; i < 8; ++i) {
    ways[i] = corners[i] - ball_.center();
    ways_about[i] = about(ways[i]);
  }
  if (holds_one_of(ways)) return Verdict::yes;
  return is_separated(cell, corners, ways_about) ? Verdict::no : Verdict::uncertain;
}

// Shells have no faces at which a spot could end.
bool SpotDecider::ends_at_face(const ShellCell&) const {
  return false;
}
// On lattices rims of spots end at a plane up to roundoffs: then 106 bits show whether the plane is between, without a
// search.
template <class PlaneCell>
bool SpotDecider::ends_at_face(const PlaneCell& cell) const {
  if (std::isinf(light_.range)) return false;
  const Point apex = about(ball_.center()), axis_about = about(axis_), axis = (1.0 / length(axis_about)) * axis_about;
  const Corners corners = exact_corners(cell);
  return any_face_normal(cell, [&](const Point& normal) {
    double least = std::numeric_limits<double>::infinity();
    for (const Point& corner : corners) least = std::min(least, dot(normal, corner - apex));
    const double lean = cosine_.value * dot(normal, axis) + sine_.value * length(cross(normal, axis));
    const double end = light_.range * lean;
    if (!(end > 0.0) || !(std::abs(least - end) <= k_near_zero * (std::abs(least) + end))) return false;
    Spot106 spot = spot_106();
    spot.range = Enclosure106(light_.range);
    std::array<Point106, 8> exactly_there;
    for (std::size_t i = 0; i < 8; ++i) exactly_there[i] = corner_of(cell, i);
    return spot.surely_separated(point_106(normal), exactly_there);
  });
}

Verdict SpotDecider::meets_quickly(const Cell& cell) const {
  const bool is_endless = std::isinf(light_.range);
  if (!is_endless && !ball_.meets(cell)) return Verdict::no;
  const auto nearest = std::visit([&](const auto& shape) { return ball_.nearest_point(shape); }, cell);
  if (nearest) {
    // Ball and cell share the nearest point, and no points far from it.
    if (leans(nearest->way) == Verdict::yes) return Verdict::yes;
    if (!is_endless && leans(widened(nearest->way, nearest->play)) == Verdict::no) return Verdict::no;
  }
  return apex_.meets(cell) ? Verdict::yes : Verdict::uncertain;
}

Verdict SpotDecider::meets_when_close(const Cell& cell) const {
  const Verdict verdict = meets_quickly(cell);
  if (verdict != Verdict::uncertain) return verdict;
  return std::visit([&](const auto& shape) { return ends_at_face(shape); }, cell) ? Verdict::no : Verdict::uncertain;
}

Verdict SpotDecider::meets_by_proof(const Cell& cell) const {
  ++exact_decisions_;
  const Verdict verdict = std::visit([&](const auto& shape) { return by_evidence(shape); }, cell);
  if (verdict != Verdict::uncertain) return verdict;
  if (!std::isinf(light_.range)) {
    const std::optional<bool> is_on_axis = axis_meets(light_, cell);
    if (is_on_axis && *is_on_axis) return Verdict::yes;
    if (is_on_axis && light_.half_angle_rad == 0.0) return Verdict::no;
  }
  return std::visit([&](const auto& shape) { return decide_spot(light_, shape); }, cell);
}

Verdict SpotDecider::meets(const Cell& cell, bool is_close) const {
  Verdict verdict = is_close ? meets_when_close(cell) : Verdict::uncertain;
  if (verdict == Verdict::uncertain) verdict = filter().meets(cell);
  if (verdict == Verdict::uncertain && !is_close) verdict = meets_quickly(cell);
  return verdict == Verdict::uncertain ? meets_by_proof(cell) : verdict;
}

const LightFilter& SpotDecider::filter() const {
  if (!filter_) filter_.emplace(light_);
  return *filter_;
}

}  // namespace clusterbench::geom
