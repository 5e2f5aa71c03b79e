#include "assign/cone/spot_bounding_spheres.h"

#include <algorithm>
#include <limits>

#include "assign/simd/lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assign/cone/spot_bounding_spheres.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target
#include <hwy/highway.h>

#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {
namespace {

struct Spheres {
  V x, y, z, radius;
};

struct Cones {
  V axis_x, axis_y, axis_z, cos_angle, sin_angle;
};

// geom::bounding_ball
HWY_INLINE Spheres around(const Spheres& range, const Cones& cone) {
  const auto is_narrow = cone.cos_angle > cone.sin_angle;
  const V along = IfThenElse(is_narrow, range.radius / (all(2.0f) * cone.cos_angle), range.radius * cone.cos_angle);
  const V radius = IfThenElse(is_narrow, along, range.radius * cone.sin_angle);
  const V size = Abs(range.x) + Abs(range.y) + Abs(range.z);
  const Spheres ball{range.x + along * cone.axis_x, range.y + along * cone.axis_y, range.z + along * cone.axis_z,
                     radius + all(0x1p-20f) * (size + range.radius)};
  const auto is_endless = range.radius == all(std::numeric_limits<float>::infinity());
  return {IfThenElse(is_endless, range.x, ball.x), IfThenElse(is_endless, range.y, ball.y),
          IfThenElse(is_endless, range.z, ball.z), IfThenElse(is_endless, range.radius, ball.radius)};
}

void spot_balls(const view::LightArrays& lights, float roundoffs, bool around_cones, BallArrays& balls) {
  const D d;
  const auto n = static_cast<std::uint32_t>(Lanes(d));
  for (std::uint32_t i = 0; i < lights.spots.count; i += n) {
    const std::uint32_t left = std::min(n, lights.spots.count - i);
    const auto load = [&](const float* from) { return loaded(from + i, left); };
    const auto of_light = [&](const std::vector<float>& list) { return load(list.data() + lights.spots.first); };
    const auto of_spot = [&](const std::vector<float>& list) { return load(list.data()); };
    const V given = of_light(lights.radius);
    Spheres ball{of_light(lights.x), of_light(lights.y), of_light(lights.z),
                 padded(given, of_light(lights.reach), roundoffs)};
    if (around_cones)
      ball = around(ball, {of_spot(lights.axis_x), of_spot(lights.axis_y), of_spot(lights.axis_z),
                           of_spot(lights.cos_angle), of_spot(lights.sin_angle)});
    StoreU(ball.x, d, balls.x.data() + i);
    StoreU(ball.y, d, balls.y.data() + i);
    StoreU(ball.z, d, balls.z.data() + i);
    const auto has_volume = given > Zero(d);
    StoreU(IfThenElseZero(has_volume, ball.radius), d, balls.radius.data() + i);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(spot_balls);

void BallArrays::resize(std::size_t size) {
  for (std::vector<float>* list : {&x, &y, &z, &radius}) list->resize(size + k_most_lanes);
}

void find_spot_balls(const view::LightArrays& lights, float roundoffs, bool around_cones, BallArrays& balls) {
  balls.resize(lights.spots.count);
  HWY_DYNAMIC_DISPATCH(spot_balls)(lights, roundoffs, around_cones, balls);
}

}  // namespace clusterbench::assign
#endif
