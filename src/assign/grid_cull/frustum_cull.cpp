#include "assign/grid_cull/frustum_cull.h"

#include <algorithm>
#include <cmath>

#define HWY_TARGET_INCLUDE "assign/grid_cull/frustum_cull.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target

#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign::HWY_NAMESPACE {
namespace {

// The sides of the picture as planes through the eye (orthographic: along the view axis), and the depths at which the
// grid begins and ends.
class View {
 public:
  explicit View(const RowPlanes& planes)
      : orthographic_(planes.orthographic),
        left_(side(planes.left)),
        right_(side(planes.right)),
        top_(side(planes.slope.front())),
        bottom_(side(planes.slope[static_cast<std::size_t>(planes.rows)])),
        near_(planes.depth.front()),
        far_(planes.depth.back()) {}

  // A lower bound of the distance of a point outside.
  HWY_INLINE V gap(V x, V y, V depth) const {
    const V across = Max(Neg(beyond(left_, x, depth)), beyond(right_, x, depth));
    const V up = Max(beyond(top_, y, depth), Neg(beyond(bottom_, y, depth)));
    const V along = Max(all(near_) - depth, depth - all(far_));
    return Max(across, Max(up, along));
  }

 private:
  struct Side {
    float slope, length;
  };
  static Side side(float slope) { return {slope, 1.0f / std::sqrt(1.0f + slope * slope)}; }
  HWY_INLINE V beyond(const Side& side, V coordinate, V depth) const {
    if (orthographic_) return coordinate - all(side.slope);
    return (coordinate - all(side.slope) * depth) * all(side.length);
  }

  bool orthographic_;
  Side left_, right_, top_, bottom_;
  float near_, far_;
};

// Searches depths among the slice planes by bisection. The first levels of the search are in registers, and so are the
// planes halfway between those.
class SliceSearch {
 public:
  explicit SliceSearch(const RowPlanes& planes)
      : planes_(planes.searched.data()),
        count_(static_cast<std::int32_t>(planes.searched.size())),
        stride_(std::max(1, count_ / static_cast<std::int32_t>(RegisterTable::size()))),
        some_(every(0)),
        between_(every(stride_ / 2)),
        last_(planes.slices - 1) {}

  // The number of planes between two slices that are below a depth (with or_at: below or at it).
  template <bool or_at>
  HWY_INLINE VI planes_below(V depth) const {
    VI below = Zero(DI());
    const auto go_on = [&](VI probe, V plane) {
      const M is_below = or_at ? plane <= depth : plane < depth;
      below = IfThenElse(RebindMask(DI(), is_below), probe, below);
    };
    for (std::int32_t step = count_ / stride_ / 2; step > 0; step /= 2) {
      const VI probe = below + all(step);
      go_on(probe, some_.at(probe));
    }
    if (stride_ == 1) return Min(below, all(last_));
    const V between = between_.at(below);
    below = below * all(stride_);
    go_on(below + all(stride_ / 2), between);
    for (std::int32_t step = stride_ / 4; step > 0; step /= 2) {
      const VI probe = below + all(step);
      go_on(probe, gathered(planes_, probe));
    }
    return Min(below, all(last_));
  }

 private:
  // Every stride-th plane, starting at `skipped`.
  RegisterTable every(std::int32_t skipped) const {
    const auto from = [&](std::int32_t first) {
      const VI index = from_on(first) * all(stride_) + all(skipped);
      return gathered(planes_, Min(index, all(count_ - 1)));
    };
    return {from(0), from(static_cast<std::int32_t>(Lanes(D())))};
  }

  const float* planes_;
  std::int32_t count_, stride_;
  RegisterTable some_, between_;
  std::int32_t last_;
};

void cull(const RowPlanes& planes, const GivenBalls& balls, VisibleBalls& visible, float roundoffs) {
  const View view(planes);
  const std::uint32_t before = visible.count;
  for (std::uint32_t i = 0; i < balls.lights.count; i += lane_count()) {
    const std::uint32_t left = std::min(lane_count(), balls.lights.count - i);
    const auto load = [&](const float* from) { return loaded(from + i, left); };
    const V x = load(balls.x), y = load(balls.y), depth = Neg(load(balls.z)), given = load(balls.radius);
    const V reach = load(balls.reach), slack = reach * all(roundoffs * 0x1p-24f);
    const V radius = given + slack;
    const M reaches = And(view.gap(x, y, depth) <= radius, given > Zero(D()));
    const M wanted = And(reaches, FirstN(D(), left));
    const std::size_t kept = CountTrue(D(), wanted);
    if (kept == 0) continue;
    const auto append = [&, count = visible.count](auto value, auto& to) {
      store_wanted(value, wanted, to.data() + count);
    };
    append(x, visible.x);
    append(y, visible.y);
    append(depth, visible.depth);
    // Powers of a reach must be normal numbers; other balls get the whole grid, to be decided later.
    const M is_in_range = is_between(all(planes.least_reach), reach, all(k_most_row_reach));
    append(IfThenElse(is_in_range, radius, infinity()), visible.radius);
    append(slack, visible.slack);
    append(BitCast(DU(), from_on(static_cast<std::int32_t>(balls.lights.first + i))), visible.light);
    visible.count += static_cast<std::uint32_t>(kept);
  }
  const SliceSearch search(planes);
  for (std::uint32_t i = before; i < visible.count; i += lane_count()) {
    const V depth = LoadU(D(), visible.depth.data() + i), radius = LoadU(D(), visible.radius.data() + i);
    const VI first = search.planes_below<false>(depth - radius);
    const VI last = search.planes_below<true>(depth + radius);
    StoreU(first, DI(), visible.first_slice.data() + i);
    StoreU(last, DI(), visible.last_slice.data() + i);
  }
}

}  // namespace
}  // namespace clusterbench::assign::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(cull);

void cull_balls(const RowPlanes& planes, const GivenBalls& balls, VisibleBalls& visible, float roundoffs) {
  HWY_DYNAMIC_DISPATCH(cull)(planes, balls, visible, roundoffs);
}

}  // namespace clusterbench::assign
#endif
