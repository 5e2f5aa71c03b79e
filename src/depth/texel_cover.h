#pragma once
// Whether triangles cover a texel without a gap, seen from the light, and how far away their farthest point in it is.

#include <array>
#include <functional>
#include <optional>
#include <span>

#include "depth/ray_caster.h"

namespace clusterbench::depth {

// What a ray from the light meets.
using CastRay = std::function<std::optional<SurfaceHit>(const Vec3d& along)>;

// `corners`: the texel's directions, around. `found`: what has been met already. Cuts away what each triangle covers
// and casts a ray through the middle of what is left, until nothing is left or too many rays were cast. The distance
// of the farthest covered point, +inf where a gap may be left. All directions between the corners meet a surface at
// most so far away, but for gaps narrower than k_narrowest_gap; and none of these surfaces is nearer than near_m.
double covered_distance(const std::array<Vec3d, 4>& corners, std::span<const SurfaceHit> found, const CastRay& cast,
                        double near_m);

}  // namespace clusterbench::depth
