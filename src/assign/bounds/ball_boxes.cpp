#include "assign/bounds/ball_boxes.h"

#define HWY_TARGET_INCLUDE "assign/bounds/ball_boxes.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target

#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign::HWY_NAMESPACE {
namespace {

// geom::ball_touches_box, along one axis.
HWY_INLINE V squared_gap(const float* centers, float lo, float hi) {
  const V outside = gap(all(lo), LoadU(D(), centers), all(hi));
  return outside * outside;
}

std::uint32_t lights_touching(const float* const* centers, const float* squared_radii, const std::uint32_t* lights,
                              std::uint32_t count, const geom::Box& box, std::uint32_t* out) {
  std::uint32_t found = 0;
  for (std::uint32_t i = 0; i < count; i += lane_count()) {
    const V squared = squared_gap(centers[0] + i, box.lo.x, box.hi.x) +
                      squared_gap(centers[1] + i, box.lo.y, box.hi.y) + squared_gap(centers[2] + i, box.lo.z, box.hi.z);
    const M touches = And(FirstN(D(), count - i), squared <= LoadU(D(), squared_radii + i));
    store_wanted(LoadU(DU(), lights + i), touches, out + found);
    found += static_cast<std::uint32_t>(CountTrue(D(), touches));
  }
  return found;
}

}  // namespace
}  // namespace clusterbench::assign::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(lights_touching);

std::uint32_t BallLanes::touching(const geom::Box& box, std::uint32_t* out) const {
  const float* const centers[] = {x_.data(), y_.data(), z_.data()};
  return HWY_DYNAMIC_DISPATCH(lights_touching)(centers, squared_radius_.data(), light_.data(), count_, box, out);
}

}  // namespace clusterbench::assign
#endif
