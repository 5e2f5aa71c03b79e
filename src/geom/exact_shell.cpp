#include "geom/exact_shell.h"

#include "geom/exact_cells.h"

namespace clusterbench::geom {

bool ball_meets_exactly(const Placement& center, double radius, const ShellPiece& cell) {
  const RationalPoint c = exact_point(center);
  return reaches(c, exact(radius), nearest_point(cell, c));
}

}  // namespace clusterbench::geom
