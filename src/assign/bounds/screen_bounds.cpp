#include "assign/bounds/screen_bounds.h"

#define HWY_TARGET_INCLUDE "assign/bounds/screen_bounds.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target

#include "assign/bounds/bounds_rows-inl.h"
#include "assign/rows/disks-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign::HWY_NAMESPACE {
namespace {

// The extents of balls in the picture.
struct Extents {
  V low_x, high_x, low_y, high_y;
};

// Of the first `count` balls; other lanes are undefined.
HWY_INLINE Extents extents_of(const BoxPlanes& planes, const Balls& balls, std::size_t count) {
  const Parts x(balls.x), y(balls.y), depth(balls.depth), radius(balls.radius);
  Parts low_x = x, high_x = x, low_y = y, high_y = y;
  for (std::size_t part = 0; part < Parts::k_count && part * Lanes(DD()) < count; ++part) {
    const Disks disks(depth.wide(part), radius.wide(part), planes.depths.front(), planes.depths.back());
    const auto find = [&](const Parts& center, Parts& low, Parts& high) {
      const VD u = center.wide(part);
      const Hull range = planes.orthographic ? disks.offset_range(u) : disks.slope_range(u);
      low.set(part, range.low);
      high.set(part, range.high);
    };
    find(x, low_x, high_x);
    find(y, low_y, high_y);
  }
  return {low_x.whole(), high_x.whole(), low_y.whole(), high_y.whole()};
}

// Appends the visible balls from index `begin` on whose extents touch cells.
void find_boxes(const BoxPlanes& planes, const VisibleBalls& visible, std::uint32_t begin, const GivenBalls& given,
                const BallPadding& padding, BoundedBalls& bounded) {
  for (std::uint32_t i = begin; i < visible.count; i += lane_count()) {
    const auto at = [&](const AlignedVector<float>& list) { return LoadU(D(), list.data() + i); };
    const VU light = LoadU(DU(), visible.light.data() + i);
    // Lanes beyond the last ball are undefined.
    const VU index = Min(light - all(given.lights.first), all(given.lights.count - 1));
    const V radius = gathered(given.radius, BitCast(DI(), index)), reach = gathered(given.reach, BitCast(DI(), index));
    Balls balls{at(visible.x), at(visible.y), at(visible.depth), padded(radius, reach, padding.box)};
    const Extents extents = extents_of(planes, balls, visible.count - i);
    const auto guess = [&](const AlignedVector<std::int32_t>& list) { return LoadU(DI(), list.data() + i); };
    const CellRanges cells{touched(planes.columns, extents.low_x, extents.high_x),
                           touched(planes.rows, Neg(extents.high_y), Neg(extents.low_y)),
                           {first_touched(planes.depths, guess(visible.first_slice), balls.depth - balls.radius),
                            last_touched(planes.depths, guess(visible.last_slice), balls.depth + balls.radius)}};
    const auto is_some = [&](const Indices& some) { return RebindMask(D(), Not(some.last < some.first)); };
    const M has_extents = And(extents.low_x <= extents.high_x, extents.low_y <= extents.high_y);
    const M has_cells = And(is_some(cells.columns), And(is_some(cells.rows), is_some(cells.slices)));
    balls.radius = padded(radius, reach, padding.ball);
    const M wanted = And(FirstN(D(), visible.count - i), And(has_extents, has_cells));
    write_cells(cells, bounded,
                [&, count = bounded.count](VI indices, auto& to) { store_wanted(indices, wanted, to.data() + count); });
    append_balls(wanted, balls, light, bounded);
  }
}

}  // namespace
}  // namespace clusterbench::assign::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(find_boxes);

BoxPlanes::BoxPlanes(const grid::ScreenGrid& grid)
    : depths(grid.slices.boundaries), orthographic(grid.tiles.orthographic) {
  // An edge tile may be clipped, so the first tile defines the width.
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
