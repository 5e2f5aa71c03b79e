#pragma once
// Do a light's volume and a cell share a point? Touching counts. The one question that geom answers; its README.md says
// in which steps.

#include "geom/shapes/cell.h"
#include "geom/shapes/light_volume.h"
#include "geom/shapes/verdict.h"

namespace clusterbench::geom {

// Balls and boxes: exact, never uncertain. Spots: proven, or uncertain (undecided), in the order of
// geom/spot/spot_decider.h.
Verdict decide_meets(const LightVolume& light, const Cell& cell);
// The same without the filter, to hold it against: slower.
Verdict prove_meets(const LightVolume& light, const Cell& cell);

}  // namespace clusterbench::geom
