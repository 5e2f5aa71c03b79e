#pragma once
// A spot (ball ∩ solid cone) against a cell, for what the double-precision filter leaves open. Every yes and every no
// is proven in exact numbers or between proven bounds; what 256 bits find only says where to look for a proof.

#include "geom/light_volume.h"
#include "geom/shapes.h"
#include "geom/verdict.h"

namespace clusterbench::geom {

// Open only if neither can be proven: volume and cell touch, or miss touching, by less than about 2^-150 of the scene's
// size (shell pieces: 2^-75 where the volume is tangent to a tile plane). Exact touching is proven where it does not
// depend on the half-angle: at the apex, or where the cell's point nearest to the apex lies in the cone, at the range.
// With cells bounded by planes no other exact touching exists for half-angles but 0: the cosine of a rational angle is
// transcendental (Lindemann), and at a touch on the cone's side or rim it would be algebraic.
Verdict decide_spot(const LightVolume& light, const FrustumPiece& cell);
Verdict decide_spot(const LightVolume& light, const Box& cell);
Verdict decide_spot(const LightVolume& light, const ShellPiece& cell);

}  // namespace clusterbench::geom
