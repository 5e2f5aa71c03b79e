#include "assign/bounds/ball_boxes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assign/bounds/ball_boxes.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target
#include <hwy/highway.h>

#include "assign/simd/compress-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using FloatLanes = hn::ScalableTag<float>;

// geom::ball_touches_box, along one axis.
HWY_INLINE hn::Vec<FloatLanes> squared_gap_of(const float* centers, float lo, float hi) {
  const FloatLanes d;
  const auto center = LoadU(d, centers);
  const auto gap = Max(Zero(d), Max(Set(d, lo) - center, center - Set(d, hi)));
  return gap * gap;
}

std::uint32_t lights_touching(const float* const* centers, const float* squared_radii, const std::uint32_t* lights,
                              std::uint32_t count, const geom::Box& box, std::uint32_t* out) {
  const FloatLanes d;
  const hn::RebindToUnsigned<FloatLanes> du;
  const auto lanes = static_cast<std::uint32_t>(Lanes(d));
  std::uint32_t found = 0;
  for (std::uint32_t i = 0; i < count; i += lanes) {
    const auto squared = squared_gap_of(centers[0] + i, box.lo.x, box.hi.x) +
                         squared_gap_of(centers[1] + i, box.lo.y, box.hi.y) +
                         squared_gap_of(centers[2] + i, box.lo.z, box.hi.z);
    const auto is_there = FirstN(d, count - i);
    const auto touches = And(is_there, squared <= LoadU(d, squared_radii + i));
    StoreU(compressed(du, LoadU(du, lights + i), RebindMask(du, touches)), du, out + found);
    found += static_cast<std::uint32_t>(CountTrue(d, touches));
  }
  return found;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
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
