// Balls with their boxes of cells in vectors, for files that are compiled once per target. Included after
// hwy/highway.h; defines its names anew for each target.

#if defined(CLUSTERBENCH_BOUNDS_ROWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLUSTERBENCH_BOUNDS_ROWS_INL_H
#undef CLUSTERBENCH_BOUNDS_ROWS_INL_H
#else
#define CLUSTERBENCH_BOUNDS_ROWS_INL_H
#endif

#include "assign/bounds/bounds_rows.h"
#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {

// The boxes of a batch.
class Boxes {
 public:
  HWY_INLINE explicit Boxes(const BallBatch& batch)
      : indices(BitCast(DI(), LoadU(DU(), batch.balls))),
        first_row(gathered(batch.bounded.first_row, indices)),
        first_column(gathered(batch.bounded.first_column, indices)) {
    lights = GatherIndex(DU(), batch.bounded.light.data(), indices);
    rows = gathered(batch.bounded.last_row, indices) - first_row + all_int(1);
    rows = IfThenElseZero(FirstN(DI(), batch.count), rows);
    columns = gathered(batch.bounded.last_column, indices) - first_column + all_int(1);
    // Below all lights (lights are fewer than 2^31), none is uncertain.
    uncertain = IfThenElseZero(Not(lights < Set(DU(), batch.first_uncertain)), Set(DU(), BatchRows::k_uncertain));
  }

  // Leaves out the balls that do not reach the slice.
  HWY_INLINE void keep(M reaches) { rows = IfThenElseZero(RebindMask(DI(), reaches), rows); }

  // Prepares the answer; false if there are no rows.
  HWY_INLINE bool start(int grid_rows, std::uint32_t count, BatchRows& out) const {
    const DI di;
    out.lanes = static_cast<std::uint32_t>(Lanes(di));
    const auto row_count = static_cast<std::uint32_t>(GetLane(SumOfLanes(di, rows)));
    out.tests = count + row_count;
    const auto has_rows = rows > Zero(di);
    out.first_row = GetLane(MinOfLanes(di, IfThenElse(has_rows, first_row, all_int(grid_rows))));
    out.last_row = GetLane(MaxOfLanes(di, IfThenElseZero(has_rows, first_row + rows))) - 1;
    if (row_count == 0) return false;
    StoreU(lights, DU(), out.lights);
    out.make_room(grid_rows);
    return true;
  }

  // The columns first .. last (counted from the box's first) as a batch's answer has them.
  HWY_INLINE VU entry(VI first, VI last) const {
    const VU from = BitCast(DU(), first_column + first), to = BitCast(DU(), first_column + last);
    return Or(Or(from, ShiftLeft<16>(to)), uncertain);
  }

  VI indices, first_row, rows, first_column, columns;  // how many rows and columns
  VU lights, uncertain;
};

// Takes each lane through its rows. entry_of(row, wanted) is the answer of the wanted lanes for their row.
template <class EntryOf>
HWY_INLINE void walk_rows(const Boxes& boxes, int grid_rows, BatchRows& out, EntryOf&& entry_of) {
  const DI di;
  const auto lanes = static_cast<int>(Lanes(di));
  for (int row = out.first_row; row <= out.last_row; ++row)
    StoreU(Set(DU(), BatchRows::k_none), DU(), out.columns.data() + row * lanes);
  const int most = GetLane(MaxOfLanes(di, boxes.rows));
  VI row = boxes.first_row, to = row * all_int(lanes) + Iota(di, 0);
  for (int i = 0; i < most; ++i) {
    const MI wanted = boxes.rows > all_int(i);
    const VU entry = entry_of(row, wanted);
    ScatterIndex(BitCast(di, entry), di, reinterpret_cast<std::int32_t*>(out.columns.data()),
                 IfThenElse(wanted, to, all_int(grid_rows * lanes)));
    row = row + all_int(1);
    to = to + all_int(lanes);
  }
}

struct Balls {
  V x, y, depth, radius;
};

// Appends the wanted ones of a vector of balls, of lights `first_light` .., without their boxes.
HWY_INLINE void keep_balls(M wanted, const Balls& balls, std::uint32_t first_light, BoundedBalls& bounded) {
  const Appender append(wanted, bounded.count);
  append(balls.x, bounded.x);
  append(balls.y, bounded.y);
  append(balls.depth, bounded.depth);
  append(balls.radius, bounded.radius);
  append(Iota(DU(), first_light), bounded.light);
  bounded.count += static_cast<std::uint32_t>(CountTrue(D(), wanted));
}

}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
HWY_AFTER_NAMESPACE();

#endif
