#pragma once
// Ball against a cell bounded by planes, decided exactly in rational arithmetic. Slow (tens of microseconds and more):
// for what a filter leaves open.

#include "geom/placement.h"
#include "geom/shapes.h"

namespace clusterbench::geom {

// Is the distance from the placed centre to the closed cell at most radius? Touching counts. radius: finite, >= 0.
bool ball_meets_exactly(const Placement& center, double radius, const FrustumPiece& cell);
bool ball_meets_exactly(const Placement& center, double radius, const Box& cell);

// How a ball meets the pyramid of a shell piece, without its shells: not at all, in a single point (which then lies
// between the shells or not), or in more than that.
enum class PyramidContact { none, point_in_shell, point_outside_shell, overlap };
PyramidContact pyramid_contact(const Placement& center, double radius, const ShellPiece& cell);

// Does the closed cell hold the placed point? A shell piece's distance bounds are compared squared.
bool holds_exactly(const Cell& cell, const Placement& point);

}  // namespace clusterbench::geom
