#include "geom/exact_shell.h"

#include "geom/exact_cells.h"

namespace clusterbench::geom {

bool ball_meets_exactly(const Placement& center, double radius, const ShellPiece& cell) {
  const RationalPoint c = exact_point(center);
  const Rational square = squared(exact(radius));
  const NearestOnShells nearest = nearest_point(cell, c);
  if (!nearest.distance) return squared_distance(c, nearest.towards) <= square;
  // t² - 2 t (v·c) / |v| + |c|² <= r², times |v|².
  const Rational &t = *nearest.distance, size = dot(nearest.towards, nearest.towards);
  return at_most_root((squared(t) + dot(c, c) - square) * size, 2 * t * dot(nearest.towards, c), size);
}

}  // namespace clusterbench::geom
