// What the kernels that fill BatchRows share. For files that are compiled once per target; included after
// hwy/highway.h; defines its names anew for each target.

#if defined(CLUSTERBENCH_BATCH_ROWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLUSTERBENCH_BATCH_ROWS_INL_H
#undef CLUSTERBENCH_BATCH_ROWS_INL_H
#else
#define CLUSTERBENCH_BATCH_ROWS_INL_H
#endif

#include "assign/simd/slice_rows.h"
#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {

// What is known of a batch before its columns: the rows that each ball may touch, which light it is of, and the columns
// that it has in every row unless they are found to be others.
HWY_INLINE void start_batch(int grid_rows, VI first_row, VI row_count, VU lights, VU columns, BatchRows& out) {
  const DI di;
  const std::size_t n = hn::Lanes(di);
  out.lanes = static_cast<std::uint32_t>(n);
  out.make_room(grid_rows);
  out.open_count = 0;
  hn::StoreU(lights, DU(), out.lights);
  out.tests = static_cast<std::uint32_t>(hn::GetLane(hn::SumOfLanes(di, row_count)));
  const MI touches = hn::Gt(row_count, hn::Zero(di));
  const VI end = hn::IfThenElseZero(touches, hn::Add(first_row, row_count));
  out.first_row = hn::GetLane(hn::MinOfLanes(di, hn::IfThenElse(touches, first_row, all_int(grid_rows))));
  out.last_row = hn::GetLane(hn::MaxOfLanes(di, end)) - 1;
  for (int row = out.first_row; row <= out.last_row; ++row)
    hn::StoreU(columns, DU(), out.columns.data() + static_cast<std::size_t>(row) * n);
}

// Lists what is uncertain of some columns. `places`: where these stand in the batch.
HWY_INLINE void list_open(VU columns, VI places, BatchRows& out) {
  const DU du;
  const auto is_open = hn::And(hn::TestBit(columns, hn::Set(du, BatchRows::k_uncertain)),
                               hn::Ne(columns, hn::Set(du, BatchRows::k_none)));
  if (hn::AllFalse(du, is_open)) return;
  hn::StoreU(compressed(du, hn::BitCast(du, places), is_open), du, out.open.data() + out.open_count);
  out.open_count += static_cast<std::uint32_t>(hn::CountTrue(du, is_open));
}

// See Certainty in slice_rows.cpp; for rows straight ahead. `rate`: the most columns that a metre to the side can be.
// Balls that hold all of the slice's part of the view, whose farthest corner's squared distance is given, by more than
// their slack, have no ends there.
HWY_INLINE V least_area_of(V radius, V slack, V rate, V farthest) {
  const V area = hn::Mul(hn::Mul(all(8.2f), hn::Mul(slack, radius)), hn::Mul(rate, rate));
  const V surely = hn::Sub(radius, hn::Mul(all(4.0f), slack));
  // An infinite radius stands for one that is left to be decided.
  const M is_sure = hn::And(hn::Gt(surely, hn::Zero(D())), hn::Lt(surely, infinity()));
  const M holds_view = hn::And(is_sure, hn::Lt(farthest, hn::Mul(surely, surely)));
  return hn::IfThenElse(holds_view, hn::Zero(D()), area);
}

// The same by a chord: with a place in the row's part of the picture from which the ball's surface is at least half a
// chord away, also rows are certain where the way from an end to the next boundary inwards, in columns, times that is
// at least 4 slack R rate (and some for rounding), and half the chord squared at least 4 slack R. `steepness` is
// least_area's.
HWY_INLINE M is_certain_by_chord(V half_square, V inwards, V radius, V slack, V rate, V steepness) {
  const V least = hn::Mul(all(5.0f), hn::Mul(slack, radius)), way = hn::Mul(least, rate);
  // An infinite radius has no chord.
  return hn::And(hn::And(is_between(least, half_square, all(1e30f)), hn::Ge(inwards, hn::Zero(D()))),
                 hn::Ge(hn::Mul(hn::Mul(inwards, inwards), half_square), hn::Mul(hn::Mul(way, way), steepness)));
}

// How far a place is outside an interval.
HWY_INLINE V gap(V low, V place, V high) {
  return hn::Max(hn::Zero(D()), hn::Max(hn::Sub(low, place), hn::Sub(place, high)));
}

// How far a place is from the farther end of an interval.
HWY_INLINE V farther_end(V place, float low, float high) {
  return hn::Max(hn::Abs(hn::Sub(place, all(low))), hn::Abs(hn::Sub(place, all(high))));
}

// Slopes from low to high as columns, as BatchRows has them. An end is certain where the way from there to the next
// boundary inwards, times the width, is at least least_area times steepness(low, high), all in columns, or where
// by_chord(way inwards, steepness) says so.
template <class Steepness, class ByChord>
HWY_INLINE VU columns_between(const RowPlanes& planes, V all_low, V all_high, M wanted, V least_area,
                              Steepness&& steepness_of, ByChord&& by_chord) {
  const V left = all(planes.left), right = all(planes.right), scale = all(planes.columns_per_slope);
  const V margin = all(planes.column_margin), one = all(1.0f);
  const M touches = hn::And(wanted, hn::And(hn::Le(all_low, hn::Min(all_high, right)), hn::Ge(all_high, left)));
  const V low = hn::Max(all_low, left), high = hn::Min(all_high, right);
  const V from = hn::Mul(hn::Sub(low, left), scale), to = hn::Mul(hn::Sub(high, left), scale);
  const V last_column = all(static_cast<float>(planes.columns - 1));
  const V first = hn::Min(hn::Floor(hn::Max(hn::Sub(from, margin), hn::Zero(D()))), last_column);
  const V last = hn::Min(hn::Floor(hn::Add(to, margin)), last_column);
  // No wider than it is for certain: a small ball in a wide picture is narrower than places in it are rounded.
  const V width = hn::Max(hn::Sub(hn::Sub(to, from), hn::Add(margin, margin)), hn::Zero(D())),
          steepness = steepness_of(low, high), area = hn::Mul(least_area, steepness);
  const V from_first = hn::Sub(hn::Sub(hn::Add(first, one), from), margin),
          to_last = hn::Sub(hn::Sub(to, last), margin);
  const V inwards = hn::Min(from_first, to_last);
  const M is_wide = hn::Ge(hn::Mul(width, width), hn::Add(area, area));
  const M is_certain = hn::And(hn::Ge(hn::Mul(inwards, width), area), is_wide);
  const DU du;
  const VU ends = hn::BitCast(du, hn::Or(whole(first), hn::ShiftLeft<16>(whole(last))));
  VU marks = hn::Zero(du);
  if (!hn::AllTrue(D(), hn::Or(is_certain, hn::Not(touches)))) {
    const auto end_is_certain = [&](V inwards_of_end) {
      const M by_area = hn::And(hn::Ge(hn::Mul(inwards_of_end, width), area), is_wide);
      return hn::Or(by_area, by_chord(inwards_of_end, steepness));
    };
    const auto mark = [&](M where, std::uint32_t bits) {
      return hn::IfThenElseZero(hn::RebindMask(du, where), hn::Set(du, bits));
    };
    const M of_first = end_is_certain(from_first), of_last = end_is_certain(to_last);
    const VU certain =
        hn::Or(mark(of_first, BatchRows::k_first_is_certain), mark(of_last, BatchRows::k_last_is_certain));
    marks = hn::IfThenElseZero(hn::RebindMask(du, hn::Not(hn::And(of_first, of_last))),
                               hn::Or(certain, hn::Set(du, BatchRows::k_uncertain)));
  }
  return hn::IfThenElse(hn::RebindMask(du, touches), hn::Or(ends, marks), hn::Set(du, BatchRows::k_none));
}

}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
HWY_AFTER_NAMESPACE();

#endif
