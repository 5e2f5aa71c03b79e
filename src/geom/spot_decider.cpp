#include "geom/spot_decider.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geom/exact_axis.h"
#include "geom/gjk.h"
#include "geom/spot.h"

namespace clusterbench::geom {
namespace {

using Point = Point3<double>;
using BoundedPoint = Point3<Bounded>;

constexpr double k_infinity = std::numeric_limits<double>::infinity();

// What a search in doubles takes for nothing, relative to the numbers involved. Whatever it finds is proven, so it only
// has to be more than rounding.
constexpr double k_hardly = 0x1p-40;

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

// The library's sines and cosines are right to 2 roundings, see geom/meets.cpp.
Bounded nearly(double value) {
  return value == 0.0 ? Bounded(0.0) : Bounded(value, std::abs(value) * 0x1p-51);
}

template <class PlaneCell>
std::array<BoundedPoint, 8> corners_of(const PlaneCell& cell) {
  std::array<BoundedPoint, 8> corners;
  const Corners exact = exact_corners(cell);
  for (std::size_t i = 0; i < 8; ++i) corners[i] = exactly(exact[i]);
  return corners;
}
std::array<BoundedPoint, 8> corners_of(const ShellPiece& cell) {
  std::array<BoundedPoint, 8> corners;
  for (unsigned i = 0; i < 4; ++i) {
    const BoundedPoint ray{(i & 1) != 0 ? cell.x1 : cell.x0, (i & 2) != 0 ? cell.y1 : cell.y0, -1.0};
    const Bounded size = sqrt(dot(ray, ray));
    corners[i] = (Bounded(cell.distance0) / size) * ray;
    corners[i + 4] = (Bounded(cell.distance1) / size) * ray;
  }
  return corners;
}

// Into the cell, by sides.
template <class Take>
void each_slope_normal(float x0, float x1, float y0, float y1, Take&& take) {
  take(Point{1.0, 0.0, x0});
  take(Point{-1.0, 0.0, -x1});
  take(Point{0.0, 1.0, y0});
  take(Point{0.0, -1.0, -y1});
}
template <class Take>
void each_face_normal(const Box&, Take&& take) {
  for (const double sign : {1.0, -1.0}) {
    take(Point{sign, 0.0, 0.0});
    take(Point{0.0, sign, 0.0});
    take(Point{0.0, 0.0, sign});
  }
}
template <class Take>
void each_face_normal(const FrustumPiece& cell, Take&& take) {
  if (cell.orthographic) return each_face_normal(Box{}, take);
  take(Point{0.0, 0.0, 1.0});
  take(Point{0.0, 0.0, -1.0});
  each_slope_normal(cell.x0, cell.x1, cell.y0, cell.y1, take);
}
// A shell is nearest to the eye's plane at its corners, and has a middle.
template <class Take>
void each_face_normal(const ShellPiece& cell, Take&& take) {
  const Point middle{0.5 * (double{cell.x0} + double{cell.x1}), 0.5 * (double{cell.y0} + double{cell.y1}), -1.0};
  take(Point{0.0, 0.0, -1.0});
  take(middle);
  take(-1.0 * middle);
  each_slope_normal(cell.x0, cell.x1, cell.y0, cell.y1, take);
}

// The least of normal·p over a cell.
Bounded least_over(const std::array<BoundedPoint, 8>& corners, const BoundedPoint& normal) {
  Bounded least = dot(normal, corners[0]);
  for (std::size_t i = 1; i < 8; ++i) least = least_of(least, dot(normal, corners[i]));
  return least;
}
template <class PlaneCell>
Bounded least_over(const PlaneCell&, const std::array<BoundedPoint, 8>& corners, const BoundedPoint& normal) {
  return least_over(corners, normal);
}
// Over t u for t between the shells and u a direction of the pyramid, it is -t times how far the opposite of the normal
// is ahead of the eye.
Bounded least_over(const ShellPiece& cell, const std::array<BoundedPoint, 8>&, const BoundedPoint& normal) {
  const Bounded ahead = farthest_ahead(Bounded(-1.0) * normal, cell);
  if (ahead.is_surely_above(0.0)) return -(Bounded(cell.distance1) * ahead);
  if (ahead.is_surely_not_above(0.0)) return -(Bounded(cell.distance0) * ahead);
  return {0.0, bounded::rounded_up(cell.distance1 * (std::abs(ahead.value) + ahead.error))};
}

// Of the planes through the apex and an edge; w: corners from the apex.
template <class PlaneCell, class Take>
void each_edge_normal(const PlaneCell&, const Point&, const std::array<Point, 8>& w, Take&& take) {
  for (unsigned corner = 0; corner < 8; ++corner)
    for (const unsigned bit : {1u, 2u, 4u})
      if ((corner & bit) == 0) take(cross(w[corner], w[corner | bit] - w[corner]));
}
// Edges from shell to shell lie on rays.
template <class Take>
void each_edge_normal(const ShellPiece& cell, const Point& apex, const std::array<Point, 8>&, Take&& take) {
  for (const float x : {cell.x0, cell.x1})
    for (const float y : {cell.y0, cell.y1}) take(cross(apex, Point{x, y, -1.0}));
}

// The cell's point where n·p is least, about.
template <class PlaneCell>
Point least_point(const PlaneCell&, const std::array<Point, 8>& corners, const Point& n) {
  return *std::min_element(corners.begin(), corners.end(),
                           [&](const Point& a, const Point& b) { return dot(n, a) < dot(n, b); });
}
// With respect to the apex, as the corners. On the far shell wherever the pyramid's nearest point to -n is.
Point least_point(const ShellPiece& cell, const std::array<Point, 8>& corners, const Point& n, const Point& apex) {
  const Point ahead = about(foot_on_pyramid(Bounded(-1.0) * exactly(n), cell));
  const double size = length(ahead);
  if (size > 0.0) return (cell.distance1 / size) * ahead - apex;
  return least_point(FrustumPiece{}, corners, n);
}
template <class PlaneCell>
Point least_point(const PlaneCell& cell, const std::array<Point, 8>& corners, const Point& n, const Point&) {
  return least_point(cell, corners, n);
}

// The point of the volume where n·p is largest, from its apex; unit axis.
Point farthest_of_volume(const Point& n, const Point& axis, double range, double cosine, double sine) {
  const double size = length(n);
  if (!(size > 0.0)) return {0.0, 0.0, 0.0};
  const double along = dot(n, axis);
  if (along >= cosine * size) return (range / size) * n;
  const Point across = n - along * axis;
  const double aside = length(across);
  if (!(aside > 0.0) || cosine * along + sine * aside <= 0.0) return {0.0, 0.0, 0.0};
  return (range * cosine) * axis + (range * sine / aside) * across;
}

}  // namespace

SpotDecider::SpotDecider(const LightVolume& light)
    : light_(light),
      ball_(light.apex, std::isinf(light.range) ? 0.0 : light.range),
      apex_(light.apex, 0.0),
      axis_(turned(light.apex.rotation, light.direction)),
      axis_square_(dot(axis_, axis_)) {
  const double half_angle = std::min(light.half_angle_rad, std::numbers::pi / 2.0);
  cosine_ = nearly(std::cos(half_angle));
  sine_ = nearly(std::sin(half_angle));
}

Verdict SpotDecider::leans(const BoundedPoint& way) const {
  const Bounded along = dot(way, axis_);
  const BoundedPoint across = cross(way, axis_);
  const Bounded inside = squared(sine_ * along), outside = squared(cosine_) * dot(across, across);
  if (along.is_surely_above(0.0) && (inside - outside).is_surely_above(0.0)) return Verdict::yes;
  // No half-angle is quite 90°: in doubles it is less.
  const bool is_away = along.is_surely_not_above(0.0) || (outside - inside).is_surely_above(0.0);
  if (is_away) return dot(way, way).is_surely_above(0.0) ? Verdict::no : Verdict::open;
  const bool is_exact = way.x.error == 0.0 && way.y.error == 0.0 && way.z.error == 0.0;
  return is_exact && along.is_surely_above(0.0) ? tightly().leans(tight(about(way))) : Verdict::open;
}

const TightSpot& SpotDecider::tightly() const {
  if (!tightly_) tightly_.emplace(light_, 0.0);
  return *tightly_;
}

// The volume extends from its apex along a unit vector w by range if w is in the cone, else by range times
// cos(angle of w to the axis - half-angle), if that is positive. If the cosine is negative, it has but its apex in
// common with the plane through it.
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
  return !less.is_surely_above(0.0) && tightly().surely_leans_away(tight(normal));
}

template <class AnyCell>
Verdict SpotDecider::by_evidence(const AnyCell& cell) const {
  const std::array<BoundedPoint, 8> corners = corners_of(cell);
  const BoundedPoint& apex = ball_.center();
  std::array<BoundedPoint, 8> ways;
  std::array<Point, 8> w;
  double size = 0.0;
  for (std::size_t i = 0; i < 8; ++i) {
    ways[i] = corners[i] - apex;
    w[i] = about(ways[i]);
    size = std::max(size, length(w[i]));
  }
  const Bounded square_range = Bounded(light_.range) * light_.range;
  for (const BoundedPoint& way : ways)
    if (dot(way, way).value <= square_range.value * (1.0 + k_hardly) && leans(way) == Verdict::yes &&
        (std::isinf(light_.range) || (dot(way, way) - square_range).is_surely_not_above(0.0)))
      return Verdict::yes;

  const Point axis_given = about(axis_), axis = (1.0 / length(axis_given)) * axis_given;
  const double cosine = cosine_.value, sine = sine_.value;
  bool found = false;
  const auto prove = [&](const Point& normal) {
    const BoundedPoint n = exactly(normal);
    found = separates(cell, normal, least_over(cell, corners, n) - dot(n, apex));
  };
  // Of any length.
  const auto try_normal = [&](const Point& normal) {
    if (found) return;
    const double normal_size = length(normal), hardly = k_hardly * size;
    if (!(normal_size > 0.0)) return;
    std::size_t least_at = 0;
    double least = k_infinity;
    for (std::size_t i = 0; i < 8 && least >= -hardly; ++i) {
      const double ahead = dot(normal, w[i]) / normal_size;
      if (ahead < least) least_at = i;
      least = std::min(least, ahead);
    }
    if (!(least >= -hardly)) return;
    const double lean = (cosine * dot(normal, axis) + sine * length(cross(normal, axis))) / normal_size;
    if (!(light_.range * lean <= least + hardly)) return;
    prove(normal);
    // Through the apex, and nearly touching both cone and cell: half the way between them.
    const double distance = length(w[least_at]);
    if (found || !(least < hardly) || !(lean < 0.0) || !(lean > -k_hardly) || !(distance > 0.0)) return;
    prove(normal - (0.5 * lean * normal_size / distance) * w[least_at]);
  };
  try_normal(-1.0 * axis_given);
  each_face_normal(cell, try_normal);
  for (const Point& way : w) try_normal(dot(way, axis_given) * way - dot(way, way) * axis_given);
  each_edge_normal(cell, about(apex), w, [&](const Point& normal) {
    try_normal(normal);
    try_normal(-1.0 * normal);
  });
  if (found) return Verdict::no;
  const double range = std::min(light_.range, 1.01 * size);
  const auto least = [&](const Point& n) {
    return least_point(cell, w, n, about(apex)) - farthest_of_volume(n, axis, range, cosine, sine);
  };
  const bool is_apart = try_separating_directions(w[0] + w[7], least, [&](const Point& n) {
    prove(n);
    return found;
  });
  return is_apart ? Verdict::no : Verdict::open;
}

Verdict SpotDecider::meets_quickly(const Cell& cell) const {
  const bool is_endless = std::isinf(light_.range);
  if (!is_endless && !ball_.meets(cell)) return Verdict::no;
  if (apex_.meets(cell)) return Verdict::yes;
  const auto nearest = std::visit([&](const auto& shape) { return ball_.nearest_point(shape); }, cell);
  if (nearest) {
    // Ball and cell have the nearest point in common, and nothing far from it.
    if (leans(nearest->way) == Verdict::yes) return Verdict::yes;
    if (!is_endless && leans(widened(nearest->way, nearest->play)) == Verdict::no) return Verdict::no;
  }
  return Verdict::open;
}

Verdict SpotDecider::meets_after_all(const Cell& cell) const {
  ++exact_decisions_;
  const Verdict verdict = std::visit([&](const auto& shape) { return by_evidence(shape); }, cell);
  if (verdict != Verdict::open) return verdict;
  if (!std::isinf(light_.range)) {
    const std::optional<bool> is_on_axis = axis_meets(light_, cell);
    if (is_on_axis && *is_on_axis) return Verdict::yes;
    if (is_on_axis && light_.half_angle_rad == 0.0) return Verdict::no;
  }
  return std::visit([&](const auto& shape) { return decide_spot(light_, shape); }, cell);
}

Verdict SpotDecider::meets(const Cell& cell) const {
  const Verdict verdict = meets_quickly(cell);
  return verdict == Verdict::open ? meets_after_all(cell) : verdict;
}

}  // namespace clusterbench::geom
