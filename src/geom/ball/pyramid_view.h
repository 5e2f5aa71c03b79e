#pragma once
// A tile's pyramid as a point sees it: its nearest point, and its direction that leans to the point most.

#include <cstdint>

#include "geom/numbers/bounded_double.h"
#include "geom/numbers/point3.h"
#include "geom/shapes/cell.h"

namespace clusterbench::geom {

// Where a cell's point nearest to a centre lies along one axis: on the lower or upper side, or between them.
enum class Side : std::int8_t { low, between, high };

// Where, by depth, a slab between tile planes is nearest to a centre, about. The squared distance to what the slab
// has at a depth is a convex function of depth whose second derivative is at least 2, so wherever it is looked at, the
// least is not more than a quarter of the derivative's square below.
struct NearestDepth {
  Side x, y, depth;   // which planes the nearest point lies on: a guess
  double at;          // a depth of the slab
  Bounded looked_at;  // that depth, or, if it is_level, the centre's: a depth of the slab, too
  bool is_level;      // nothing nearer is less deep or deeper
  Bounded square;     // of the distance there
  double steepness;   // half of the derivative there is at most this

  double undershoot() const { return steepness == 0.0 ? 0.0 : bounded::rounded_up(steepness * steepness); }
};

// The tile's whole pyramid as a ball's centre sees it: all that its cells in different shells have in common.
struct PyramidView {
  NearestDepth nearest;
  // Of all directions in the pyramid, how far ahead the centre is in the one that leans to it most: the distance of the
  // nearest point from the eye, or, where that is the eye itself (or nearly), not positive (or hardly).
  Bounded along;
  bool is_behind;
};

// How far a point (or its direction times its length) is ahead in the direction of a tile's pyramid that leans to it
// most; negative if all lean away from it.
Bounded farthest_ahead(const Point3<Bounded>& point, const ShellCell& tile);

// The point of a tile's pyramid that is nearest to a point, about.
Point3<Bounded> foot_on_pyramid(const Point3<Bounded>& point, const ShellCell& tile);

}  // namespace clusterbench::geom
