#include "geom/exact_ball.h"

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <optional>

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

// Squared distance from c to its nearest point with the coordinates tied as given, if that point lies in the piece.
std::optional<Rational> squared_distance(const Point& c, const Piece& piece, const Tied& x, const Tied& y,
                                         int depth_choice) {
  const Rational depth =
      depth_choice < 2 ? piece.depth[static_cast<std::size_t>(depth_choice)] : nearest_depth(c, x, y);
  const Rational px = x.free ? c.x : x.slope * depth, py = y.free ? c.y : y.slope * depth;
  const bool inside =
      piece.depth[0] <= depth && depth <= piece.depth[1] && within(px, piece.x, depth) && within(py, piece.y, depth);
  if (!inside) return std::nullopt;
  return squared(px - c.x) + squared(py - c.y) + squared(depth - c.depth);
}

// The nearest point of a convex polytope is the projection of the centre onto the span of one of its faces, edges or
// corners, or the centre itself: three choices (low, high, free) per pair of planes. Any that lies in the cell is a
// point of the cell, so it is enough that one is near enough.
bool piece_is_within(const Point& c, const Piece& piece, const Rational& squared_radius) {
  const auto tied = [](const std::array<Rational, 2>& slopes, int choice) {
    return choice < 2 ? Tied{false, slopes[static_cast<std::size_t>(choice)]} : Tied{true, 0};
  };
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y)
      for (int depth = 0; depth < 3; ++depth) {
        const auto distance = squared_distance(c, piece, tied(piece.x, x), tied(piece.y, y), depth);
        if (distance && *distance <= squared_radius) return true;
      }
  return false;
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

bool holds_exactly(const Cell& cell, const Placement& point) {
  return std::visit(Holds{exact_point(point)}, cell);
}

}  // namespace clusterbench::geom
