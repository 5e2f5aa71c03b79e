#pragma once
// Ball against a shell piece (a pyramid through the eye cut by two shells), decided exactly in rational arithmetic.
// Slow (tens of microseconds and more): for what a filter leaves open.

#include "geom/placement.h"
#include "geom/shapes.h"

namespace clusterbench::geom {

// Is the distance from the placed centre to the closed cell at most radius? Touching counts. Metres.
// radius: finite, >= 0; the cell's distances: finite, ascending, >= 0.
bool ball_meets_exactly(const Placement& center, double radius, const ShellPiece& cell);

}  // namespace clusterbench::geom
