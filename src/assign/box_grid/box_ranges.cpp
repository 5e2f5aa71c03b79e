#include "assign/box_grid/box_ranges.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assign/box_grid/box_ranges.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target
#include <hwy/highway.h>

#include "assign/bounds/bounds_rows-inl.h"
#include "assign/simd/boundaries-inl.h"
#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {
namespace {

// Along an axis; a negated coordinate has the same distances from negated boundaries.
HWY_INLINE V on_axis(const RangeAxis& axis, V coordinate) {
  return axis.descends ? Neg(coordinate) : coordinate;
}

// Whether the grid as a whole is within reach. Boxes are adjacent: so is one of them, then.
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
  const DI di;
  return AndNot(range.first < Set(di, hole.first), Not(range.last > Set(di, hole.last)));
}

// Those that reach the grid; without their ranges.
void see_reaching(const RangeAxes& axes, const GivenBalls& balls, float roundoffs, BoundedBalls& bounded) {
  const D d;
  const auto n = static_cast<std::uint32_t>(Lanes(d));
  for (std::uint32_t i = 0; i < balls.lights.count; i += n) {
    const std::uint32_t left = std::min(n, balls.lights.count - i);
    const auto load = [&](const float* from) { return loaded(from + i, left); };
    const V x = load(balls.x), y = load(balls.y), z = load(balls.z), given = load(balls.radius);
    const V radius = padded(given, load(balls.reach), roundoffs);
    const M on_all = And(reaches(axes.x, x, radius), And(reaches(axes.y, y, radius), reaches(axes.z, z, radius)));
    const M wanted = And(And(given > Zero(d), FirstN(d, left)), on_all);
    keep_balls(wanted, {x, y, Neg(z), radius}, balls.lights.first + i, bounded);
  }
}

// The ranges of the balls from `begin` on. Those in the hole reach no slice.
void find_ranges(const RangeAxes& axes, std::uint32_t begin, BoundedBalls& bounded) {
  const D d;
  const DI di;
  const auto n = static_cast<std::uint32_t>(Lanes(d));
  for (std::uint32_t i = begin; i < bounded.count; i += n) {
    const auto at = [&](const AlignedVector<float>& list) { return LoadU(d, list.data() + i); };
    const V radius = at(bounded.radius);
    const Indices x = range_on(axes.x, at(bounded.x), radius), y = range_on(axes.y, at(bounded.y), radius);
    Indices z = range_on(axes.z, Neg(at(bounded.depth)), radius);
    const MI in_hole = And(lies_in(x, axes.hole_x), And(lies_in(y, axes.hole_y), lies_in(z, axes.hole_z)));
    z.last = IfThenElse(in_hole, Set(di, -1), z.last);
    const auto keep = [&](const Indices& range, AlignedVector<std::int32_t>& first, AlignedVector<std::int32_t>& last) {
      StoreU(range.first, di, first.data() + i);
      StoreU(range.last, di, last.data() + i);
    };
    keep(x, bounded.first_column, bounded.last_column);
    keep(y, bounded.first_row, bounded.last_row);
    keep(z, bounded.first_slice, bounded.last_slice);
  }
}

void box_ranges(const RangeAxes& axes, const GivenBalls& balls, float roundoffs, BoundedBalls& bounded) {
  const std::uint32_t begin = bounded.count;
  see_reaching(axes, balls, roundoffs, bounded);
  find_ranges(axes, begin, bounded);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
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
  CellExtents cells;
  const auto axis_of = [](const BoxAxis& extents) {
    CellExtents::Axis axis;
    for (const Interval& extent : extents) {
      axis.lo.push_back(extent.lo);
      axis.hi.push_back(extent.hi);
    }
    return axis;
  };
  cells.x = axis_of(boxes.x);
  cells.y = axis_of(boxes.y);
  cells.z = axis_of(boxes.z);
  cells.columns = static_cast<int>(boxes.x.size());
  cells.rows = static_cast<int>(boxes.y.size());
  return cells;
}

void find_box_ranges(const RangeAxes& axes, const GivenBalls& balls, float roundoffs, BoundedBalls& bounded) {
  HWY_DYNAMIC_DISPATCH(box_ranges)(axes, balls, roundoffs, bounded);
}

}  // namespace clusterbench::assign
#endif
