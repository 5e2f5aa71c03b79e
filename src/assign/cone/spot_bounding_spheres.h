#pragma once
// The balls around many spots at once: geom::bounding_ball of LightArrays::cone, the same operations in the same order.

#include <cstdint>
#include <vector>

#include "assign/cull/frustum_cull.h"
#include "core/arrays.h"
#include "view/frame.h"

namespace clusterbench::assign {

// Balls in arrays, with room for whole vectors beyond the last.
struct BallArrays {
  std::vector<float> x, y, z, radius;

  std::size_t capacity_bytes() const { return bytes_of(x, y, z, radius); }
};

// Ball i is that of spot i, larger by these roundoffs: around its cone or, if not `around_cones`, the ball of its
// range. Spots without volume get radius 0.
void find_spot_balls(const view::LightArrays& lights, float roundoffs, bool around_cones, BallArrays& balls);

inline GivenBalls given_points(const view::LightArrays& lights) {
  return {lights.x.data(), lights.y.data(), lights.z.data(), lights.radius.data(), lights.reach.data(), lights.points};
}
// `balls`: those of all spots.
inline GivenBalls given_spots(const view::LightArrays& lights, const BallArrays& balls) {
  return {balls.x.data(), balls.y.data(), balls.z.data(), balls.radius.data(), lights.reach.data() + lights.spots.first,
          lights.spots};
}

}  // namespace clusterbench::assign
