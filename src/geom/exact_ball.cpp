#include "geom/exact_ball.h"

#include "geom/exact_cells.h"

namespace clusterbench::geom {
namespace {

template <class PlaneCell>
bool is_within(const Placement& center, double radius, const PlaneCell& cell) {
  const RationalPoint c = exact_point(center);
  return squared_distance(c, nearest_point(cell, c)) <= squared(exact(radius));
}

}  // namespace

bool ball_meets_exactly(const Placement& center, double radius, const FrustumPiece& cell) {
  return is_within(center, radius, cell);
}

bool ball_meets_exactly(const Placement& center, double radius, const Box& cell) {
  return is_within(center, radius, cell);
}

bool holds_exactly(const Cell& cell, const Placement& point) {
  return holds(cell, exact_point(point));
}

}  // namespace clusterbench::geom
