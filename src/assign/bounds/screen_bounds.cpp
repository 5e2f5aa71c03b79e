#include "assign/bounds/screen_bounds.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assign/bounds/screen_bounds.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target
#include <hwy/highway.h>

#include "assign/rows/disks-inl.h"
#include "assign/simd/boundaries-inl.h"
#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {
namespace {

void find_extents(const BoxPlanes& planes, const VisibleBalls& visible, std::uint32_t begin, BoundedBalls& bounded) {
  const DD dd;
  const DF df;
  const auto n = static_cast<std::uint32_t>(Lanes(dd));
  for (std::uint32_t i = begin; i < visible.count; i += n) {
    const auto wide = [&](const AlignedVector<float>& from) { return PromoteTo(dd, LoadU(df, from.data() + i)); };
    const Disks disks(wide(visible.depth), wide(bounded.box_radius), planes.depths.front(), planes.depths.back());
    const auto find = [&](const AlignedVector<float>& center, AlignedVector<float>& to_low,
                          AlignedVector<float>& to_high) {
      VF low, high;
      if (planes.orthographic)
        disks.offset_range(wide(center), low, high);
      else
        disks.slope_range(wide(center), low, high);
      StoreU(low, df, to_low.data() + i);
      StoreU(high, df, to_high.data() + i);
    };
    find(visible.x, bounded.low_x, bounded.high_x);
    find(visible.y, bounded.low_y, bounded.high_y);
  }
}

void find_radii(const VisibleBalls& visible, std::uint32_t begin, const GivenBalls& given, const BallPadding& padding,
                BoundedBalls& bounded) {
  const D d;
  const DI di;
  const hn::RebindToUnsigned<D> du;
  const auto n = static_cast<std::uint32_t>(Lanes(d));
  for (std::uint32_t i = begin; i < visible.count; i += n) {
    const auto light = Min(LoadU(du, visible.light.data() + i), Set(du, given.lights.end() - 1));
    const VI index = BitCast(di, Max(light, Set(du, given.lights.first)) - Set(du, given.lights.first));
    const V radius = GatherIndex(d, given.radius, index), reach = GatherIndex(d, given.reach, index);
    StoreU(padded(radius, reach, padding.box), d, bounded.box_radius.data() + i);
    StoreU(padded(radius, reach, padding.ball), d, bounded.ball_radius.data() + i);
  }
}

// Those of the visible balls from `begin` on whose extents touch cells.
void box_balls(const BoxPlanes& planes, const VisibleBalls& visible, std::uint32_t begin, BoundedBalls& bounded) {
  const D d;
  const DI di;
  const auto n = static_cast<std::uint32_t>(Lanes(d));
  for (std::uint32_t i = begin; i < visible.count; i += n) {
    const auto at = [&](const AlignedVector<float>& list) { return LoadU(d, list.data() + i); };
    const V x = at(visible.x), y = at(visible.y), depth = at(visible.depth), r = at(bounded.box_radius);
    const V low_x = at(bounded.low_x), high_x = at(bounded.high_x), low_y = at(bounded.low_y),
            high_y = at(bounded.high_y);
    const Indices columns = touched(planes.columns, low_x, high_x);
    const Indices rows = touched(planes.rows, Neg(high_y), Neg(low_y));
    const auto guess = [&](const AlignedVector<std::int32_t>& list) { return LoadU(di, list.data() + i); };
    const Indices slices{first_touched(planes.depths, guess(visible.first_slice), depth - r),
                         last_touched(planes.depths, guess(visible.last_slice), depth + r)};
    const auto is_some = [&](const Indices& some) { return RebindMask(d, Not(some.last < some.first)); };
    const auto has_extents = And(low_x <= high_x, low_y <= high_y);
    const auto has_cells = And(is_some(columns), And(is_some(rows), is_some(slices)));
    const auto wanted = And(FirstN(d, visible.count - i), And(has_extents, has_cells));
    const Appender append(wanted, bounded.count);
    append(x, bounded.x);
    append(y, bounded.y);
    append(depth, bounded.depth);
    append(at(bounded.ball_radius), bounded.radius);
    append(LoadU(DU(), visible.light.data() + i), bounded.light);
    append(columns.first, bounded.first_column);
    append(columns.last, bounded.last_column);
    append(rows.first, bounded.first_row);
    append(rows.last, bounded.last_row);
    append(slices.first, bounded.first_slice);
    append(slices.last, bounded.last_slice);
    bounded.count += static_cast<std::uint32_t>(CountTrue(d, wanted));
  }
}

void find_boxes(const BoxPlanes& planes, const VisibleBalls& visible, std::uint32_t begin, const GivenBalls& given,
                const BallPadding& padding, BoundedBalls& bounded) {
  find_radii(visible, begin, given, padding, bounded);
  find_extents(planes, visible, begin, bounded);
  box_balls(planes, visible, begin, bounded);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(find_boxes);

BoxPlanes::BoxPlanes(const grid::ScreenGrid& grid)
    : depths(grid.slices.boundaries), orthographic(grid.tiles.orthographic) {
  // An edge tile may be clipped: the first one tells the width.
  const std::vector<float>&x = grid.tiles.x, &y = grid.tiles.y;
  columns = {x, x[0], 1.0f / (x[1] - x[0])};
  rows = {y, -y[0], 1.0f / (y[0] - y[1])};
  for (float& slope : rows.boundaries) slope = -slope;
}

void find_screen_bounds(const BoxPlanes& planes, const VisibleBalls& visible, std::uint32_t begin,
                        const GivenBalls& given, const BallPadding& padding, BoundedBalls& bounded) {
  HWY_DYNAMIC_DISPATCH(find_boxes)(planes, visible, begin, given, padding, bounded);
}

}  // namespace clusterbench::assign
#endif
