#pragma once
// Cells in exact numbers. Points are in the cell's space: view space, or the space of a grid's boxes.

#include <array>
#include <optional>
#include <vector>

#include "geom/numbers/rational.h"
#include "geom/shapes/cell.h"
#include "geom/shapes/polytope.h"

namespace clusterbench::geom {

// The planes that bound the cell; for a shell cell, the planes of its pyramid. Normals are not of unit length.
using Planes = std::vector<HalfSpace<Rational>>;
Planes planes_of(const Cell& cell);

bool all_hold(const Planes& planes, const RationalPoint& p);
// Is the point in the closed cell? A shell cell's distance bounds are compared squared.
bool holds(const Cell& cell, const RationalPoint& p);

// The t >= 0 for which start + t * step is inside all planes: empty, or from `from` to `to`, or (without `to`) without
// end.
struct Span {
  Rational from;
  std::optional<Rational> to;
};
std::optional<Span> span_within(const Planes& planes, const RationalPoint& start, const RationalPoint& step);

// Bits of a corner's index select the low or high side: 1 for x, 2 for y, 4 for depth.
std::array<RationalPoint, 8> corners_of(const FrustumCell& cell);
std::array<RationalPoint, 8> corners_of(const Box& cell);
// The rays in which the pyramid's planes meet, by the bits 1 and 2 of the index: points at depth 1.
std::array<RationalPoint, 4> rays_of(const ShellCell& cell);

// The cell's point nearest to p.
RationalPoint nearest_point(const FrustumCell& cell, const RationalPoint& p);
RationalPoint nearest_point(const Box& cell, const RationalPoint& p);

// The shell cell's point nearest to p is `distance` from the eye in the direction of `towards` (not of unit length,
// never 0), or `towards` itself if there is no distance.
struct NearestOnShells {
  RationalPoint towards;
  std::optional<Rational> distance;
};
NearestOnShells nearest_point(const ShellCell& cell, const RationalPoint& p);
// Is its distance from p at most `reach` (>= 0)?
bool reaches(const RationalPoint& p, const Rational& reach, const NearestOnShells& nearest);

}  // namespace clusterbench::geom
