#pragma once
// Ball against a cell, decided exactly in rational arithmetic. Slow (tens of microseconds and more): only for pairs
// that cheaper steps leave uncertain.

#include "geom/shapes/cell.h"
#include "geom/shapes/placement.h"

namespace clusterbench::geom {

// Is the distance from the centre to the closed cell at most radius? Touching counts. radius: finite, >= 0.
bool ball_meets_exactly(const Placement& center, double radius, const FrustumCell& cell);
bool ball_meets_exactly(const Placement& center, double radius, const Box& cell);
// The cell's distances: finite, ascending, >= 0.
bool ball_meets_exactly(const Placement& center, double radius, const ShellCell& cell);

// Does the closed cell contain the point?
bool holds_exactly(const Cell& cell, const Placement& point);

}  // namespace clusterbench::geom
