#include "assign/box_grid/box_ranges.h"

#define HWY_TARGET_INCLUDE "assign/box_grid/box_ranges.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target

#include "assign/bounds/bounds_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign::HWY_NAMESPACE {
namespace {

// Along one axis; a negated coordinate has the same distances from negated boundaries.
HWY_INLINE V on_axis(const RangeAxis& axis, V coordinate) {
  return axis.descends ? Neg(coordinate) : coordinate;
}

// Is the grid as a whole within reach? Then one of its boxes is, too, because they are adjacent.
HWY_INLINE M reaches(const RangeAxis& axis, V given, V radius) {
  const V coordinate = on_axis(axis, given), start = all(axis.boundaries.front()), end = all(axis.boundaries.back());
  return Not(Or(start - coordinate > radius, coordinate - end > radius));
}

HWY_INLINE Indices range_on(const RangeAxis& axis, V given, V radius) {
  const V coordinate = on_axis(axis, given);
  const auto is_before = [&](V end) { return coordinate - end > radius; };
  const auto is_reached = [&](V start) { return Not(start - coordinate > radius); };
  return {last_passed(axis.boundaries, guessed(axis, coordinate - radius), 0, is_before),
          last_passed(axis.boundaries, guessed(axis, coordinate + radius), -1, is_reached)};
}

HWY_INLINE MI lies_in(const Indices& range, const grid::IndexRange& hole) {
  return AndNot(range.first < all(hole.first), Not(range.last > all(hole.last)));
}

// Balls inside the hole reach no slice.
HWY_INLINE CellRanges cells_of(const RangeAxes& axes, const Balls& balls) {
  CellRanges cells{range_on(axes.x, balls.x, balls.radius), range_on(axes.y, balls.y, balls.radius),
                   range_on(axes.z, Neg(balls.depth), balls.radius)};
  const MI is_in_hole = And(lies_in(cells.columns, axes.hole_x),
                            And(lies_in(cells.rows, axes.hole_y), lies_in(cells.slices, axes.hole_z)));
  cells.slices.last = IfThenElse(is_in_hole, all(-1), cells.slices.last);
  return cells;
}

void box_ranges(const RangeAxes& axes, const GivenBalls& given, float roundoffs, BoundedBalls& bounded) {
  const auto reaches_grid = [&](const Balls& balls) {
    return And(reaches(axes.x, balls.x, balls.radius),
               And(reaches(axes.y, balls.y, balls.radius), reaches(axes.z, Neg(balls.depth), balls.radius)));
  };
  append_given(given, roundoffs, bounded, reaches_grid, [&](const Balls& balls) { return cells_of(axes, balls); });
}

}  // namespace
}  // namespace clusterbench::assign::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(box_ranges);

RangeAxis::RangeAxis(const BoxAxis& axis) : descends(axis.front().lo > axis.back().lo) {
  boundaries.push_back(descends ? -axis.front().hi : axis.front().lo);
  for (const Interval& extent : axis) boundaries.push_back(descends ? -extent.lo : extent.hi);
  start = boundaries.front();
  per_length = static_cast<float>(axis.size()) / (boundaries.back() - start);
}

RangeAxes::RangeAxes(const BoxGrid& boxes)
    : x(boxes.x), y(boxes.y), z(boxes.z), hole_x(boxes.hole_x), hole_y(boxes.hole_y), hole_z(boxes.hole_z) {}

std::size_t RangeAxes::capacity_bytes() const {
  return bytes_of(x.boundaries, y.boundaries, z.boundaries);
}

CellExtents extents_of(const BoxGrid& boxes) {
  return {{boxes.x}, {boxes.y}, {boxes.z}, static_cast<int>(boxes.x.size()), static_cast<int>(boxes.y.size())};
}

void find_box_ranges(const RangeAxes& axes, const GivenBalls& balls, float roundoffs, BoundedBalls& bounded) {
  HWY_DYNAMIC_DISPATCH(box_ranges)(axes, balls, roundoffs, bounded);
}

}  // namespace clusterbench::assign
#endif
