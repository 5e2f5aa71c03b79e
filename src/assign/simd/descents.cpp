#include "assign/simd/descents.h"

#define HWY_TARGET_INCLUDE "assign/simd/descents.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target

#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign::HWY_NAMESPACE {
namespace {

std::uint32_t count_descents(const std::uint32_t* values, std::size_t count) {
  const std::size_t lanes = lane_count();
  VU in_lanes = Zero(DU());
  std::size_t i = 1;
  for (; i + lanes <= count; i += lanes) {
    const auto descends = LoadU(DU(), values + i) < LoadU(DU(), values + i - 1);
    in_lanes = in_lanes - VecFromMask(DU(), descends);  // the mask's lanes are 0 or -1
  }
  std::uint32_t all = GetLane(SumOfLanes(DU(), in_lanes));
  for (; i < count; ++i) all += values[i] < values[i - 1];
  return all;
}

}  // namespace
}  // namespace clusterbench::assign::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(count_descents);

std::uint32_t descents(const std::uint32_t* values, std::size_t count) {
  return HWY_DYNAMIC_DISPATCH(count_descents)(values, count);
}

}  // namespace clusterbench::assign
#endif
