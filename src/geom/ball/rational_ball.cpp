#include "geom/ball/rational_ball.h"

#include "geom/shapes/rational_cell.h"

namespace clusterbench::geom {
namespace {

template <class PlaneCell>
bool is_within(const Placement& center, double radius, const PlaneCell& cell) {
  const RationalPoint c = local_point_in<Rational>(center);
  return squared_distance(c, nearest_point(cell, c)) <= squared(exact(radius));
}

}  // namespace

bool ball_meets_exactly(const Placement& center, double radius, const FrustumCell& cell) {
  return is_within(center, radius, cell);
}

bool ball_meets_exactly(const Placement& center, double radius, const Box& cell) {
  return is_within(center, radius, cell);
}

bool ball_meets_exactly(const Placement& center, double radius, const ShellCell& cell) {
  const RationalPoint c = local_point_in<Rational>(center);
  return reaches(c, exact(radius), nearest_point(cell, c));
}

bool holds_exactly(const Cell& cell, const Placement& point) {
  return holds(cell, local_point_in<Rational>(point));
}

}  // namespace clusterbench::geom
