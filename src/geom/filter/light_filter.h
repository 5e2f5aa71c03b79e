#pragma once
// The filter: does a light's volume share a point with a cell? In double precision with a tolerance; it answers yes or
// no only if that is certain.

#include <variant>

#include "geom/box/box_decider.h"
#include "geom/shapes/cell.h"
#include "geom/shapes/light_volume.h"
#include "geom/shapes/verdict.h"

namespace clusterbench::geom {

// Distances from the eye over pyramid ∩ volume: one interval. All true distances lie in [outer_lo, outer_hi]; every
// distance in [inner_lo, inner_hi] is certainly reached. Between these two, [likely_lo, likely_hi] are the extremes
// found, without proof. An interval whose ends are in the wrong order is empty.
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
  // The following functions are for balls and spots only.
  // Distances over the tile's pyramid, without its near shell; right up to its far shell.
  DistanceInterval distances(const ShellCell& tile) const;
  // Is there a plane between the volume and the shell cell, or planes between the volume and all parts of the cell?
  bool is_surely_apart(const ShellCell& cell) const;

 private:
  const Volume<double>& volume() const { return std::get<Volume<double>>(shape_); }

  std::variant<Volume<double>, BoxDecider> shape_;
};

Verdict filter_meets(const LightVolume& light, const Cell& cell);

}  // namespace clusterbench::geom
