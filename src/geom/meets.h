#pragma once
// Do a light's volume and a cell share a point? Touching counts. First a filter in double precision that says yes or no
// only when that is certain, then exact arithmetic (balls against planes) or 256 bits (everything else).

#include "geom/candidates.h"
#include "geom/placement.h"
#include "geom/shapes.h"

namespace clusterbench::geom {

enum class Verdict { no, yes, open };

// A light by its exact ingredients. The axis is rotation * direction, not necessarily of unit length.
struct LightVolume {
  Placement apex;
  double range = 0.0;  // > 0, may be +inf
  bool is_cone = false;
  Vec3d direction{0.0, 0.0, -1.0};
  double half_angle_rad = 0.0;
};

// Slower, for what the filter leaves open. Balls: exact, never open. Spots: open when touching
// within 2^-150 of the scene's size and not provable by an exact point (the apex).
Verdict decide_meets(const LightVolume& light, const Cell& cell);

// Distances from the eye over pyramid ∩ volume: one interval. All true distances lie in [outer_lo, outer_hi]; every
// distance in [inner_lo, inner_hi] is certainly reached (nothing if that is empty).
struct DistanceInterval {
  double outer_lo = 1.0, outer_hi = 0.0, inner_lo = 1.0, inner_hi = 0.0;

  bool may_reach(double near, double far) const { return near <= outer_hi && far >= outer_lo; }
  bool surely_reaches(double near, double far) const {
    return near <= inner_hi && far >= inner_lo && inner_lo <= inner_hi;
  }
};

// The filter of one light.
class LightFilter {
 public:
  explicit LightFilter(const LightVolume& light);

  Verdict meets(const Cell& cell) const;
  // Of the tile's whole pyramid, without its shells.
  DistanceInterval distances(const ShellPiece& tile) const;

 private:
  Volume<double> volume_;
};

Verdict filter_meets(const LightVolume& light, const Cell& cell);

}  // namespace clusterbench::geom
