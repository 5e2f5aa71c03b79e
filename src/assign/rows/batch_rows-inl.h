// What the kernels that fill BatchRows share. For files that are compiled once per target; included after
// hwy/highway.h; defines its names anew for each target.

#if defined(CLUSTERBENCH_BATCH_ROWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLUSTERBENCH_BATCH_ROWS_INL_H
#undef CLUSTERBENCH_BATCH_ROWS_INL_H
#else
#define CLUSTERBENCH_BATCH_ROWS_INL_H
#endif

#include "assign/rows/slice_rows.h"
#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {

// What is known of a batch before its columns: the rows that each ball may touch.
HWY_INLINE void start_batch(int grid_rows, VI first_row, VI row_count, BatchSpans& out) {
  const DI di;
  out.count = out.uncertain_count = 0;
  out.tests = static_cast<std::uint32_t>(GetLane(SumOfLanes(di, row_count)));
  // A loop over all rows is foretold by the processor, unlike one whose ends wait for the balls.
  constexpr int k_few_rows = 32;
  if (grid_rows <= k_few_rows) {
    out.first_row = 0;
    out.last_row = grid_rows - 1;
    return;
  }
  const MI touches = row_count > Zero(di);
  const VI end = IfThenElseZero(touches, first_row + row_count);
  out.first_row = GetLane(MinOfLanes(di, IfThenElse(touches, first_row, all_int(grid_rows))));
  out.last_row = GetLane(MaxOfLanes(di, end)) - 1;
}

// Lists what is uncertain of `count` spans, at most a vector of them, from span `first` on.
HWY_INLINE void list_uncertain(VU columns, std::uint32_t count, std::uint32_t first, BatchSpans& out) {
  const DU du;
  const auto is_marked = And(TestBit(columns, Set(du, BatchRows::k_uncertain)), FirstN(du, count));
  const auto is_uncertain = And(is_marked, Ne(columns, Set(du, BatchRows::k_none)));
  if (AllFalse(du, is_uncertain)) return;
  const VU indices = BitCast(du, from_on(static_cast<std::int32_t>(first)));
  StoreU(compressed(du, indices, is_uncertain), du, out.uncertain.data() + out.uncertain_count);
  out.uncertain_count += static_cast<std::uint32_t>(CountTrue(du, is_uncertain));
}

// See Certainty in slice_rows.cpp; for rows straight ahead. `rate`: the most columns that a metre to the side can be.
// Balls that hold all of the slice's part of the view, whose farthest corner's squared distance is given, by more than
// their slack, have no ends there.
HWY_INLINE V least_area_of(V radius, V slack, V rate, V farthest) {
  const V area = all(8.2f) * (slack * radius) * (rate * rate);
  const V surely = radius - all(4.0f) * slack;
  // An infinite radius stands for one that is left to be decided.
  const M is_sure = And(surely > Zero(D()), surely < infinity());
  const M holds_view = And(is_sure, farthest < surely * surely);
  return IfThenElse(holds_view, Zero(D()), area);
}

// The same by a chord: with a point in the row's part of the picture from which the ball's surface is at least half a
// chord away, also rows are certain where the way from an end to the next boundary inwards, in columns, times that is
// at least 4 slack R rate (and some for rounding), and half the chord squared at least 4 slack R. `steepness` is
// least_area's.
HWY_INLINE M is_certain_by_chord(V half_square, V inwards, V radius, V slack, V rate, V steepness) {
  const V least = all(5.0f) * (slack * radius), way = least * rate;
  // An infinite radius has no chord.
  return And(And(is_between(least, half_square, all(1e30f)), inwards >= Zero(D())),
             inwards * inwards * half_square >= way * way * steepness);
}

// How far a coordinate is from the farther end of an interval.
HWY_INLINE V farther_end(V coordinate, float low, float high) {
  return Max(Abs(coordinate - all(low)), Abs(coordinate - all(high)));
}

// Slopes from low to high as columns, as BatchRows has them. An end is certain where the way from there to the next
// boundary inwards, times the width, is at least least_area times steepness(low, high), all in columns, or where
// by_chord(way inwards, steepness) says so.
template <class Steepness, class ByChord>
HWY_INLINE VU columns_between(const RowPlanes& planes, V all_low, V all_high, M wanted, V least_area,
                              Steepness&& steepness_of, ByChord&& by_chord) {
  const V left = all(planes.left), right = all(planes.right), scale = all(planes.columns_per_slope);
  const V tolerance = all(planes.column_tolerance);
  const M touches = And(wanted, And(all_low <= Min(all_high, right), all_high >= left));
  const V low = Max(all_low, left), high = Min(all_high, right);
  const V from = (low - left) * scale, to = (high - left) * scale;
  const V last_column = all(static_cast<float>(planes.columns - 1));
  const V first = Min(Floor(Max(from - tolerance, Zero(D()))), last_column);
  const V last = Min(Floor(to + tolerance), last_column);
  // No wider than it is for certain: a small ball in a wide picture is narrower than coordinates in it are rounded.
  const V width = Max(to - from - (tolerance + tolerance), Zero(D())), steepness = steepness_of(low, high),
          area = least_area * steepness;
  const V from_first = first + all(1.0f) - from - tolerance, to_last = to - last - tolerance;
  const V inwards = Min(from_first, to_last);
  const M is_wide = width * width >= area + area;
  const M is_certain = And(inwards * width >= area, is_wide);
  const DU du;
  const VU ends = BitCast(du, Or(whole(first), ShiftLeft<16>(whole(last))));
  VU marks = Zero(du);
  if (!AllTrue(D(), Or(is_certain, Not(touches)))) {
    const auto end_is_certain = [&](V inwards_of_end) {
      const M by_area = And(inwards_of_end * width >= area, is_wide);
      return Or(by_area, by_chord(inwards_of_end, steepness));
    };
    const auto mark = [&](M where, std::uint32_t bits) { return IfThenElseZero(RebindMask(du, where), Set(du, bits)); };
    const M of_first = end_is_certain(from_first), of_last = end_is_certain(to_last);
    const VU certain = Or(mark(of_first, BatchRows::k_first_is_certain), mark(of_last, BatchRows::k_last_is_certain));
    marks = IfThenElseZero(RebindMask(du, Not(And(of_first, of_last))), Or(certain, Set(du, BatchRows::k_uncertain)));
  }
  return IfThenElse(RebindMask(du, touches), Or(ends, marks), Set(du, BatchRows::k_none));
}

}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
HWY_AFTER_NAMESPACE();

#endif
