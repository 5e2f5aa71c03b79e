#pragma once
// A spot (ball ∩ solid cone) against a cell, for pairs that cheaper evidence leaves uncertain. Every yes and every no
// is proven between bounds of 106 bits (geom/certificate/spot_106.h) or, if these are not precise enough, in exact
// numbers or between bounds of 1,024 or 3,072 bits. Searches in doubles, 106, 256, 1,024 and 3,072 bits only propose
// evidence for such a proof.

#include "geom/shapes/cell.h"
#include "geom/shapes/light_volume.h"
#include "geom/shapes/verdict.h"

namespace clusterbench::geom {

// Uncertain if no search finds evidence that can be proven; docs/accuracy.md lists the known cases. The tests'
// lattices, random pairs and pairs a few ulps from touching have none; cones below 1e-250 rad along a plane can have
// some. Exact touching is proven if it does not depend on the half-angle: at the apex, or, at the range, if the cell's
// point nearest to the apex lies in the cone. With cells bounded by planes no other exact touching exists for
// half-angles other than 0: the cosine of a rational angle is transcendental (Lindemann), and at a touch on the cone's
// side or rim it would be algebraic.
Verdict decide_spot(const SpotVolume& light, const FrustumCell& cell);
Verdict decide_spot(const SpotVolume& light, const Box& cell);
Verdict decide_spot(const SpotVolume& light, const ShellCell& cell);

}  // namespace clusterbench::geom
