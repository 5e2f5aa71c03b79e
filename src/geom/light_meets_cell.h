#pragma once
// Do a light's volume and a cell share a point? Touching counts. This is the one result that geom computes; README.md
// lists the steps.

#include "geom/shapes/cell.h"
#include "geom/shapes/light_volume.h"
#include "geom/shapes/verdict.h"

namespace clusterbench::geom {

// Balls and boxes: exact, never uncertain. Spots: proven, or uncertain (undecided), in the order of
// geom/spot/spot_decider.h.
Verdict decide_meets(const LightVolume& light, const Cell& cell);
// The same without the filter, slower: a reference for tests.
Verdict prove_meets(const LightVolume& light, const Cell& cell);

}  // namespace clusterbench::geom
