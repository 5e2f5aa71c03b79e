#pragma once
// Do a light's volume and a cell share a point? Touching counts. First a filter in double precision that says yes or no
// only when that is certain, then exact arithmetic (balls) or a proof in exact arithmetic (spots).

#include "geom/candidates.h"
#include "geom/light_volume.h"
#include "geom/shapes.h"
#include "geom/verdict.h"

namespace clusterbench::geom {

// Balls: exact, never open. Spots: proven, or open, in the order of geom/spot_decider.h.
Verdict decide_meets(const LightVolume& light, const Cell& cell);
// The same without the filter, to hold it against: slower.
Verdict prove_meets(const LightVolume& light, const Cell& cell);

// Distances from the eye over pyramid ∩ volume: one interval. All true distances lie in [outer_lo, outer_hi]; every
// distance in [inner_lo, inner_hi] is certainly reached; between them, [likely_lo, likely_hi] is where the extremes
// were found, which proves nothing. An interval whose ends are in the wrong order is empty.
struct DistanceInterval {
  double outer_lo = 1.0, outer_hi = 0.0, inner_lo = 1.0, inner_hi = 0.0, likely_lo = 1.0, likely_hi = 0.0;

  bool may_reach(double near, double far) const { return near <= outer_hi && far >= outer_lo && outer_lo <= outer_hi; }
  bool surely_reaches(double near, double far) const {
    return near <= inner_hi && far >= inner_lo && inner_lo <= inner_hi;
  }
  bool likely_reaches(double near, double far) const {
    return near <= likely_hi && far >= likely_lo && likely_lo <= likely_hi;
  }
};

// The filter of one light.
class LightFilter {
 public:
  explicit LightFilter(const LightVolume& light);

  Verdict meets(const Cell& cell) const;
  // Of the tile's pyramid, without its near shell; right as far as its far shell.
  DistanceInterval distances(const ShellPiece& tile) const;
  // Is there a plane between the volume and the shell piece, or planes between it and parts of the piece?
  bool is_surely_apart(const ShellPiece& piece) const;

 private:
  Volume<double> volume_;
};

Verdict filter_meets(const LightVolume& light, const Cell& cell);

}  // namespace clusterbench::geom
