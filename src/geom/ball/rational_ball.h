#pragma once
// Ball against a cell, decided exactly in rational arithmetic. Slow (tens of microseconds and more):
// for what a filter leaves open.

#include "geom/shapes/cell.h"
#include "geom/shapes/placement.h"

namespace clusterbench::geom {

// Is the distance from the placed centre to the closed cell at most radius? Touching counts. radius: finite, >= 0.
bool ball_meets_exactly(const Placement& center, double radius, const FrustumPiece& cell);
bool ball_meets_exactly(const Placement& center, double radius, const Box& cell);
// The cell's distances: finite, ascending, >= 0.
bool ball_meets_exactly(const Placement& center, double radius, const ShellPiece& cell);

// Does the closed cell hold the placed point?
bool holds_exactly(const Cell& cell, const Placement& point);

}  // namespace clusterbench::geom
