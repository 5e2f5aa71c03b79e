#include "geom/exact_ball.h"

#include <array>
#include <boost/multiprecision/cpp_int.hpp>

namespace clusterbench::geom {
namespace {

using Rational = boost::multiprecision::cpp_rational;

struct Point {
  Rational x, y, depth;
};

Rational exact(double value) {
  return Rational(value);
}

Point exact_point(const Placement& place) {
  Rational t[3], local[3];
  for (int i = 0; i < 3; ++i) t[i] = exact(place.position[i]) - exact(place.origin[i]);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) local[row] += exact(place.rotation[column][row]) * t[column];
  return {local[0], local[1], -local[2]};
}

Rational clamped(const Rational& value, const Rational& lo, const Rational& hi) {
  if (value < lo) return lo;
  return value > hi ? hi : value;
}

Rational squared(const Rational& value) {
  return value * value;
}

// Bounds of a piece: x between x[0]*depth and x[1]*depth, likewise y; depth between depth[0] and depth[1].
struct Piece {
  std::array<Rational, 2> x, y, depth;
};

// One coordinate of a point of a face, edge or corner: either free, or slope * depth with the chosen slope.
struct Tied {
  bool free;
  Rational slope;
};

// The depth of the point nearest to c among those with x and y tied as given and depth free: the projection onto the
// line or plane {(slope_x * depth, slope_y * depth, depth)}, where free coordinates take the centre's own value.
Rational nearest_depth(const Point& c, const Tied& x, const Tied& y) {
  Rational numerator = c.depth, denominator = 1;
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

// Calls take(point) for the centre's projections onto the spans of all faces, edges and corners, the piece's inside
// included (three choices per pair of planes: low, high, free), as far as they lie in the piece. The nearest point of a
// convex polytope is among them, and each is a point of the piece.
template <class Take>
void projections(const Point& c, const Piece& piece, Take&& take) {
  for (int choice = 0; choice < 27; ++choice) {
    const Tied x = tied(piece.x, choice % 3), y = tied(piece.y, choice / 3 % 3);
    const std::size_t end = static_cast<std::size_t>(choice / 9);
    const Rational depth = end < 2 ? piece.depth[end] : nearest_depth(c, x, y);
    const Point p{x.free ? c.x : x.slope * depth, y.free ? c.y : y.slope * depth, depth};
    if (piece.depth[0] <= depth && depth <= piece.depth[1] && within(p.x, piece.x, depth) &&
        within(p.y, piece.y, depth))
      take(p);
  }
}

Rational squared_distance(const Point& a, const Point& b) {
  return squared(a.x - b.x) + squared(a.y - b.y) + squared(a.depth - b.depth);
}

bool piece_is_within(const Point& c, const Piece& piece, const Rational& squared_radius) {
  bool found = false;
  projections(c, piece, [&](const Point& p) { found = found || squared_distance(c, p) <= squared_radius; });
  return found;
}

bool box_is_within(const Point& c, const std::array<Rational, 6>& lo_hi, const Rational& squared_radius) {
  const Rational dx = c.x - clamped(c.x, lo_hi[0], lo_hi[1]);
  const Rational dy = c.y - clamped(c.y, lo_hi[2], lo_hi[3]);
  const Rational dd = c.depth - clamped(c.depth, lo_hi[4], lo_hi[5]);
  return squared(dx) + squared(dy) + squared(dd) <= squared_radius;
}

std::array<Rational, 6> bounds_of(const Box& box) {
  return {exact(box.lo.x), exact(box.hi.x), exact(box.lo.y), exact(box.hi.y), exact(-box.hi.z), exact(-box.lo.z)};
}

std::array<Rational, 6> bounds_of(const FrustumPiece& cell) {
  return {exact(cell.x0), exact(cell.x1), exact(cell.y0), exact(cell.y1), exact(cell.depth0), exact(cell.depth1)};
}

struct Holds {
  Point p;

  bool in_pyramid(float x0, float x1, float y0, float y1) const {
    return p.depth >= 0 && within(p.x, {exact(x0), exact(x1)}, p.depth) && within(p.y, {exact(y0), exact(y1)}, p.depth);
  }
  bool operator()(const FrustumPiece& cell) const {
    if (cell.orthographic) return box_is_within(p, bounds_of(cell), 0);
    return in_pyramid(cell.x0, cell.x1, cell.y0, cell.y1) && exact(cell.depth0) <= p.depth &&
           p.depth <= exact(cell.depth1);
  }
  bool operator()(const ShellPiece& cell) const {
    const Rational square = squared(p.x) + squared(p.y) + squared(p.depth);
    return in_pyramid(cell.x0, cell.x1, cell.y0, cell.y1) && squared(exact(cell.distance0)) <= square &&
           square <= squared(exact(cell.distance1));
  }
  bool operator()(const Box& cell) const { return box_is_within(p, bounds_of(cell), 0); }
};

}  // namespace

bool ball_meets_exactly(const Placement& center, double radius, const FrustumPiece& cell) {
  const Rational squared_radius = squared(exact(radius));
  if (cell.orthographic) return box_is_within(exact_point(center), bounds_of(cell), squared_radius);
  const Piece piece{
      {exact(cell.x0), exact(cell.x1)}, {exact(cell.y0), exact(cell.y1)}, {exact(cell.depth0), exact(cell.depth1)}};
  return piece_is_within(exact_point(center), piece, squared_radius);
}

bool ball_meets_exactly(const Placement& center, double radius, const Box& cell) {
  return box_is_within(exact_point(center), bounds_of(cell), squared(exact(radius)));
}

PyramidContact pyramid_contact(const Placement& center, double radius, const ShellPiece& cell) {
  const Point c = exact_point(center), eye{0, 0, 0};
  // The nearest point of a convex cone is no farther from its apex than the centre is.
  const Rational deepest = abs(c.x) + abs(c.y) + abs(c.depth) + 1;
  const Piece pyramid{{exact(cell.x0), exact(cell.x1)}, {exact(cell.y0), exact(cell.y1)}, {0, deepest}};
  Point nearest = eye;
  projections(c, pyramid, [&](const Point& p) {
    if (squared_distance(c, p) < squared_distance(c, nearest)) nearest = p;
  });
  const Rational apart = squared_distance(c, nearest), reach = squared(exact(radius));
  if (apart != reach) return apart < reach ? PyramidContact::overlap : PyramidContact::none;
  const Rational square = squared_distance(eye, nearest);
  const bool is_between = squared(exact(cell.distance0)) <= square && square <= squared(exact(cell.distance1));
  return is_between ? PyramidContact::point_in_shell : PyramidContact::point_outside_shell;
}

bool holds_exactly(const Cell& cell, const Placement& point) {
  return std::visit(Holds{exact_point(point)}, cell);
}

}  // namespace clusterbench::geom
