#pragma once
// A spot (ball ∩ solid cone) against a cell, for what cheaper evidence leaves uncertain. Every yes and every no
// is proven between bounds of 106 bits (geom/certificate/spot_106.h) or, where these cannot tell, in exact numbers or
// between bounds of 1,024 or 3,072 bits; what doubles, 106, 256, 1,024 and 3,072 bits find only says where to look for
// a proof.

#include "geom/shapes/cell.h"
#include "geom/shapes/light_volume.h"
#include "geom/shapes/verdict.h"

namespace clusterbench::geom {

// Uncertain where no search finds what proves it: docs/accuracy.md says what is known of that. The tests' lattices,
// random pairs and pairs a few ulps from touching have none, cones below 1e-250 rad along a plane can have. Exact
// touching is proven where it does not depend on the half-angle: at the apex, or where the cell's point nearest to the
// apex lies in the cone, at the range. With cells bounded by planes no other exact touching exists for half-angles but
// 0: the cosine of a rational angle is transcendental (Lindemann), and at a touch on the cone's side or rim it would be
// algebraic.
Verdict decide_spot(const SpotVolume& light, const FrustumCell& cell);
Verdict decide_spot(const SpotVolume& light, const Box& cell);
Verdict decide_spot(const SpotVolume& light, const ShellCell& cell);

}  // namespace clusterbench::geom
