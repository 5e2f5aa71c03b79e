#include "assign/cone/bounding_spheres.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "assign/simd/lanes.h"
#include "core/memory.h"

#define HWY_TARGET_INCLUDE "assign/cone/bounding_spheres.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target

#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign::HWY_NAMESPACE {
namespace {

// As LightArrays::bounding_ball(); without `around_cones`, the ball of the range.
void spot_balls(const view::LightArrays& lights, float roundoffs, bool around_cones, BallArrays& balls) {
  for (std::uint32_t i = 0; i < lights.spots.count; i += lane_count()) {
    const std::uint32_t left = std::min(lane_count(), lights.spots.count - i);
    const auto of_spot = [&](const std::vector<float>& list) { return loaded(list.data() + i, left); };
    const auto of_light = [&](const std::vector<float>& list) {
      return loaded(list.data() + lights.spots.first + i, left);
    };
    const V range = of_light(lights.radius), reach = of_light(lights.reach);
    V x = of_light(lights.x), y = of_light(lights.y), z = of_light(lights.z), radius = range;
    if (!around_cones) {
      radius = padded(range, reach, roundoffs);
    } else {
      const V cosine = of_spot(lights.cos_angle), sine = of_spot(lights.sin_angle);
      const M is_narrow = cosine > sine, is_endless = range == infinity();
      const V of_cone = IfThenElse(is_narrow, range / (all(2.0f) * cosine), range * cosine);
      const V around = IfThenElse(is_narrow, of_cone, range * sine);
      const V along = IfThenZeroElse(is_endless, of_cone);
      radius = IfThenElse(is_endless, range, around + all(0x1p-20f) * (Abs(x) + Abs(y) + Abs(z) + range));
      x = x + along * of_spot(lights.axis_x);
      y = y + along * of_spot(lights.axis_y);
      z = z + along * of_spot(lights.axis_z);
      radius = padded(radius, reach + range, roundoffs);
    }
    StoreU(x, D(), balls.x.data() + i);
    StoreU(y, D(), balls.y.data() + i);
    StoreU(z, D(), balls.z.data() + i);
    StoreU(IfThenElseZero(range > Zero(D()), radius), D(), balls.radius.data() + i);
  }
}

// Rows are short: longer vectors would be mostly empty and cost more.
using Few = hn::CappedTag<float, 8>;
using VFew = hn::Vec<Few>;

HWY_INLINE VFew all_few(float value) {
  return Set(Few(), value);
}

class SpotCone {
 public:
  HWY_INLINE explicit SpotCone(const geom::SphericalCone& cone)
      : apex_{all_few(cone.apex.x), all_few(cone.apex.y), all_few(cone.apex.z)},
        axis_{all_few(cone.axis.x), all_few(cone.axis.y), all_few(cone.axis.z)},
        range_(all_few(cone.range)),
        cos_angle_(all_few(cone.cos_angle)),
        sin_angle_(all_few(cone.sin_angle)),
        apex_size_(all_few(std::fabs(cone.apex.x) + std::fabs(cone.apex.y) + std::fabs(cone.apex.z))) {}

  HWY_INLINE hn::Mask<Few> touches(const CellBalls& cells, std::size_t cell) const {
    const auto at = [&](const std::vector<float>& list) { return LoadU(Few(), list.data() + cell); };
    const PointOf<VFew> to_center = PointOf<VFew>{at(cells.x), at(cells.y), at(cells.z)} - apex_;
    const VFew along = dot(to_center, axis_), across = length(to_center - along * axis_), radius = at(cells.radius);
    const VFew reach = radius + all_few(0x1p-20f) * (apex_size_ + at(cells.size));
    const VFew farthest = range_ + reach;
    const auto beside = cos_angle_ * across - sin_angle_ * along > reach;
    const auto beyond = Or(along > farthest, length(to_center) > farthest);
    const auto behind = along < Neg(reach);
    const auto is_endless = radius == all_few(std::numeric_limits<float>::infinity());
    return Or(is_endless, Not(Or(beside, Or(beyond, behind))));
  }

 private:
  PointOf<VFew> apex_, axis_;  // with z in place of the depth
  VFew range_, cos_angle_, sin_angle_, apex_size_;
};

std::uint64_t touched_of(const CellRun& run, const SpotCone& cone, const CellBalls& cells) {
  const auto lanes = static_cast<std::uint32_t>(Lanes(Few()));
  std::uint64_t bits = 0;
  for (std::uint32_t i = 0; i < run.count; i += lanes)
    bits |= std::uint64_t{bits_of(Few(), cone.touches(cells, std::size_t{run.cell} + i))} << i;
  return run.count < 64 ? bits & ((std::uint64_t{1} << run.count) - 1) : bits;
}

void touched_cells(const geom::SphericalCone& given, const CellBalls& cells, std::span<const CellRun> runs,
                   std::uint64_t* touched) {
  const SpotCone cone(given);
  for (std::size_t i = 0; i < runs.size(); ++i) touched[i] = touched_of(runs[i], cone, cells);
}

}  // namespace
}  // namespace clusterbench::assign::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(spot_balls);
HWY_EXPORT(touched_cells);

void find_spot_balls(const view::LightArrays& lights, float roundoffs, bool around_cones, BallArrays& balls) {
  grow_to(lights.spots.count + k_most_lanes, balls.x, balls.y, balls.z, balls.radius);
  HWY_DYNAMIC_DISPATCH(spot_balls)(lights, roundoffs, around_cones, balls);
}

CellBalls::CellBalls(std::span<const geom::Ball> balls) {
  const std::size_t padded = balls.size() + k_most_lanes;
  check_memory("spheres around cells, side by side", padded, 5 * sizeof(float));
  grow_to(padded, x, y, z, radius, size);
  for (std::size_t cell = 0; cell < balls.size(); ++cell) {
    const Vec3f& center = balls[cell].center;
    x[cell] = center.x;
    y[cell] = center.y;
    z[cell] = center.z;
    radius[cell] = balls[cell].radius;
    size[cell] = std::fabs(center.x) + std::fabs(center.y) + std::fabs(center.z);
  }
}

void find_touched_cells(const geom::SphericalCone& cone, const CellBalls& cells, std::span<const CellRun> runs,
                        std::vector<std::uint64_t>& touched) {
  if (touched.size() < runs.size()) touched.resize(runs.size());
  HWY_DYNAMIC_DISPATCH(touched_cells)(cone, cells, runs, touched.data());
}

}  // namespace clusterbench::assign
#endif
