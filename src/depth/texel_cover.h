#pragma once
// Whether triangles cover a texel without a gap, seen from the light, and the distance of their farthest point in it.

#include <array>
#include <functional>
#include <optional>
#include <span>

#include "depth/ray_caster.h"

namespace clusterbench::depth {

// The surface that a ray from the light meets.
using CastRay = std::function<std::optional<SurfaceHit>(const Vec3d& along)>;

// `corners`: the texel's directions, in order. `found`: surfaces that are already known. Cuts away the part that each
// triangle covers and casts a ray through the middle of the rest, until nothing is left or too many rays were cast.
// Returns the distance of the farthest covered point, +inf if there may be a gap. In all directions between the corners
// a surface is at most this far away, except in gaps narrower than k_narrowest_gap; and none of these surfaces is
// nearer than near_m.
double covered_distance(const std::array<Vec3d, 4>& corners, std::span<const SurfaceHit> found, const CastRay& cast,
                        double near_m);

}  // namespace clusterbench::depth
