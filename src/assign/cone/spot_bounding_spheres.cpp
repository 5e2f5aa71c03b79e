#include "assign/cone/spot_bounding_spheres.h"

#include <algorithm>

#include "assign/simd/lanes.h"

#define HWY_TARGET_INCLUDE "assign/cone/spot_bounding_spheres.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target

#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign::HWY_NAMESPACE {
namespace {

// geom::bounding_ball, or with `around_cones` not set the ball of the range.
void spot_balls(const view::LightArrays& lights, float roundoffs, bool around_cones, BallArrays& balls) {
  for (std::uint32_t i = 0; i < lights.spots.count; i += lane_count()) {
    const std::uint32_t left = std::min(lane_count(), lights.spots.count - i);
    const auto of_spot = [&](const std::vector<float>& list) { return loaded(list.data() + i, left); };
    const auto of_light = [&](const std::vector<float>& list) {
      return loaded(list.data() + lights.spots.first + i, left);
    };
    const V given = of_light(lights.radius), range = padded(given, of_light(lights.reach), roundoffs);
    const V x = of_light(lights.x), y = of_light(lights.y), z = of_light(lights.z);
    V along = Zero(D()), radius = range;
    if (around_cones) {
      const V cosine = of_spot(lights.cos_angle), sine = of_spot(lights.sin_angle);
      const M is_narrow = cosine > sine, is_endless = range == infinity();
      const V of_cone = IfThenElse(is_narrow, range / (all(2.0f) * cosine), range * cosine);
      const V around = IfThenElse(is_narrow, of_cone, range * sine);
      along = IfThenZeroElse(is_endless, of_cone);
      radius = IfThenElse(is_endless, range, around + all(0x1p-20f) * (Abs(x) + Abs(y) + Abs(z) + range));
    }
    StoreU(x + along * of_spot(lights.axis_x), D(), balls.x.data() + i);
    StoreU(y + along * of_spot(lights.axis_y), D(), balls.y.data() + i);
    StoreU(z + along * of_spot(lights.axis_z), D(), balls.z.data() + i);
    StoreU(IfThenElseZero(given > Zero(D()), radius), D(), balls.radius.data() + i);
  }
}

}  // namespace
}  // namespace clusterbench::assign::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(spot_balls);

void find_spot_balls(const view::LightArrays& lights, float roundoffs, bool around_cones, BallArrays& balls) {
  grow_to(lights.spots.count + k_most_lanes, balls.x, balls.y, balls.z, balls.radius);
  HWY_DYNAMIC_DISPATCH(spot_balls)(lights, roundoffs, around_cones, balls);
}

}  // namespace clusterbench::assign
#endif
