#pragma once
// A tile's pyramid relative to a point: its nearest point, and its direction that leans most towards the point.

#include <cstdint>

#include "geom/numbers/bounded_double.h"
#include "geom/numbers/point3.h"
#include "geom/shapes/cell.h"

namespace clusterbench::geom {

// The position along one axis of a cell's point nearest to a centre: on the lower or upper side, or between them.
enum class Side : std::int8_t { low, between, high };

// The approximate depth at which a slab between tile planes is nearest to a centre. The squared distance to the slab's
// cross-section is a convex function of depth with a second derivative of at least 2. So at any depth, the function's
// minimum is smaller by at most a quarter of the square of the derivative there.
struct NearestDepth {
  Side x, y, depth;      // the planes on which the nearest point lies: a guess
  double at;             // a depth of the slab
  Bounded evaluated_at;  // that depth, or, if is_level, the centre's, which is then a depth of the slab, too
  bool is_level;         // the nearest point is exactly at that depth
  Bounded square;        // of the distance there
  double steepness;      // upper bound of half the derivative there

  double undershoot() const { return steepness == 0.0 ? 0.0 : bounded::rounded_up(steepness * steepness); }
};

// A tile's whole pyramid relative to a ball's centre: the values that all its cells in different shells share.
struct PyramidView {
  NearestDepth nearest;
  // The largest component of the centre along any direction of the pyramid. It is the distance of the nearest point
  // from the eye. If the nearest point is the eye itself (or nearly), it is not positive (or hardly).
  Bounded along;
  bool is_behind;
};

// The largest component of a point (or of a vector) along any direction of a tile's pyramid; negative if all directions
// lean away from it.
Bounded farthest_ahead(const Point3<Bounded>& point, const ShellCell& tile);

// The approximate point of a tile's pyramid that is nearest to a point.
Point3<Bounded> foot_on_pyramid(const Point3<Bounded>& point, const ShellCell& tile);

}  // namespace clusterbench::geom
