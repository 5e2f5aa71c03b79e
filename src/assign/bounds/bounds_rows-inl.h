// Vectors of balls with their boxes of cells: the search of values among boundaries, and the rows of the boxes. For
// files that are compiled once per target.

#if defined(CLUSTERBENCH_BOUNDS_ROWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLUSTERBENCH_BOUNDS_ROWS_INL_H
#undef CLUSTERBENCH_BOUNDS_ROWS_INL_H
#else
#define CLUSTERBENCH_BOUNDS_ROWS_INL_H
#endif

#include "assign/bounds/boundary_axis.h"
#include "assign/bounds/bounds_rows.h"
#include "assign/grid_cull/frustum_cull.h"
#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign::HWY_NAMESPACE {

// --- Boundaries: a guess, verified with the boundaries themselves ---

// passes(boundary) is true up to some boundary and false beyond. Finds the last of boundaries `least` .. that passes,
// or `least` (0 or -1), whether it passes or not; with -1 the last boundary is not tested. Starts at the guess.
template <class Passes>
HWY_INLINE VI last_passed(const std::vector<float>& boundaries, VI guess, int least, Passes&& passes) {
  const auto count = static_cast<std::int32_t>(boundaries.size()) - 1;
  const VI zero = Zero(DI()), from = all(least), to = all(count + least);
  const auto at = [&](VI index) { return RebindMask(DI(), passes(gathered(boundaries, index))); };
  VI index = Min(Max(guess, from), to);
  for (;;) {
    const VI next = index + all(1);
    const auto goes_on = And(index < to, at(Min(next, to)));
    if (AllFalse(DI(), goes_on)) break;
    index = IfThenElse(goes_on, next, index);
  }
  for (;;) {
    const auto goes_back = AndNot(at(Max(index, zero)), index > from);
    if (AllFalse(DI(), goes_back)) return index;
    index = IfThenElse(goes_back, index - all(1), index);
  }
}

HWY_INLINE VI guessed(const BoundaryAxis& axis, V value) {
  const V at = (value - all(axis.start)) * all(axis.per_length);
  const V most = all(static_cast<float>(axis.boundaries.size()));
  return ConvertTo(DI(), Min(Max(at, Zero(D())), most));
}

struct Indices {
  VI first, last;
};

// Starts at the guessed position of a value.
HWY_INLINE VI first_touched(const std::vector<float>& boundaries, VI guess, V low) {
  return last_passed(boundaries, guess, 0, [&](V boundary) { return boundary < low; });
}
HWY_INLINE VI last_touched(const std::vector<float>& boundaries, VI guess, V high) {
  return last_passed(boundaries, guess, -1, [&](V boundary) { return boundary <= high; });
}

// grid::intervals_touched for low <= high. Empty if first > last.
HWY_INLINE Indices touched(const BoundaryAxis& axis, V low, V high) {
  return {first_touched(axis.boundaries, guessed(axis, low), low),
          last_touched(axis.boundaries, guessed(axis, high), high)};
}

// --- Boxes ---

// The boxes of a batch.
class Boxes {
 public:
  HWY_INLINE explicit Boxes(const BallBatch& batch)
      : indices(BitCast(DI(), LoadU(DU(), batch.balls))),
        first_row(gathered(batch.bounded.first_row, indices)),
        first_column(gathered(batch.bounded.first_column, indices)) {
    lights = GatherIndex(DU(), batch.bounded.light.data(), indices);
    rows = gathered(batch.bounded.last_row, indices) - first_row + all(1);
    rows = IfThenElseZero(FirstN(DI(), batch.count), rows);
    columns = gathered(batch.bounded.last_column, indices) - first_column + all(1);
    // Larger than all light indices (which are below 2^31): none is uncertain.
    uncertain = IfThenElseZero(Not(lights < all(batch.first_uncertain)), all(BatchRows::k_uncertain));
  }

  // Leaves out the balls that do not reach the slice.
  HWY_INLINE void keep(M reaches) { rows = IfThenElseZero(RebindMask(DI(), reaches), rows); }
  // The same, and limits the rows to `range`.
  HWY_INLINE void limit_rows(M reaches, const Indices& range) {
    keep(reaches);
    first_row = range.first;
    rows = IfThenElseZero(rows > Zero(DI()), Max(range.last - range.first + all(1), Zero(DI())));
  }

  // Prepares the result; false if there are no rows.
  HWY_INLINE bool start(int grid_rows, std::uint32_t count, BatchRows& out) const {
    out.lanes = static_cast<std::uint32_t>(Lanes(DI()));
    const auto row_count = static_cast<std::uint32_t>(GetLane(SumOfLanes(DI(), rows)));
    out.tests = count + row_count;
    const auto has_rows = rows > Zero(DI());
    out.first_row = GetLane(MinOfLanes(DI(), IfThenElse(has_rows, first_row, all(grid_rows))));
    out.last_row = GetLane(MaxOfLanes(DI(), IfThenElseZero(has_rows, first_row + rows))) - 1;
    if (row_count == 0) return false;
    StoreU(lights, DU(), out.lights);
    out.make_room(grid_rows);
    return true;
  }

  // The columns first .. last (counted from the box's first column) in the format of BatchRows; k_none where `are_some`
  // is false.
  HWY_INLINE VU entry(MI are_some, VI first, VI last) const {
    const VU from = BitCast(DU(), first_column + first), to = BitCast(DU(), first_column + last);
    const VU span = Or(Or(from, ShiftLeft<16>(to)), uncertain);
    return IfThenElse(RebindMask(DU(), are_some), span, all(BatchRows::k_none));
  }

  int most_columns() const { return GetLane(MaxOfLanes(DI(), IfThenElseZero(rows > Zero(DI()), columns))); }

  VI indices, first_row, rows, first_column, columns;  // number of rows and columns
  VU lights, uncertain;
};

// Walks each lane through its rows. entry_of(row, wanted) is the result of the selected lanes for their row.
template <class EntryOf>
HWY_INLINE void walk_rows(const Boxes& boxes, int grid_rows, BatchRows& out, EntryOf&& entry_of) {
  const auto lanes = static_cast<int>(Lanes(DI()));
  for (int row = out.first_row; row <= out.last_row; ++row)
    StoreU(all(BatchRows::k_none), DU(), out.columns.data() + row * lanes);
  const int most = GetLane(MaxOfLanes(DI(), boxes.rows));
  VI row = boxes.first_row, to = row * all(lanes) + Iota(DI(), 0);
  for (int i = 0; i < most; ++i) {
    const MI wanted = boxes.rows > all(i);
    const VU entry = entry_of(row, wanted);
    ScatterIndex(BitCast(DI(), entry), DI(), reinterpret_cast<std::int32_t*>(out.columns.data()),
                 IfThenElse(wanted, to, all(grid_rows * lanes)));
    row = row + all(1);
    to = to + all(lanes);
  }
}

struct Balls {
  V x, y, depth, radius;
};

// Boxes of cells. An empty range of slices: no cells.
struct CellRanges {
  Indices columns, rows, slices;
};

// write(indices, array) for each array of the boxes.
template <class Write>
HWY_INLINE void write_cells(const CellRanges& cells, BoundedBalls& out, Write&& write) {
  write(cells.columns.first, out.first_column);
  write(cells.columns.last, out.last_column);
  write(cells.rows.first, out.first_row);
  write(cells.rows.last, out.last_row);
  write(cells.slices.first, out.first_slice);
  write(cells.slices.last, out.last_slice);
}

// Appends the selected balls, without their boxes.
HWY_INLINE void append_balls(M wanted, const Balls& balls, VU lights, BoundedBalls& out) {
  const auto append = [&, count = out.count](auto value, auto& to) { store_wanted(value, wanted, to.data() + count); };
  append(balls.x, out.x);
  append(balls.y, out.y);
  append(balls.depth, out.depth);
  append(balls.radius, out.radius);
  append(lights, out.light);
  out.count += static_cast<std::uint32_t>(CountTrue(D(), wanted));
}

// Appends those of the given balls, enlarged by these roundoffs, for which reaches(balls) is true, with the boxes of
// cells from cells_of(balls).
template <class Reaches, class CellsOf>
HWY_INLINE void append_given(const GivenBalls& given, float roundoffs, BoundedBalls& out, Reaches&& reaches,
                             CellsOf&& cells_of) {
  const std::uint32_t n = lane_count(), begin = out.count;
  for (std::uint32_t i = 0; i < given.lights.count; i += n) {
    const std::uint32_t left = std::min(n, given.lights.count - i);
    const auto load = [&](const float* from) { return loaded(from + i, left); };
    const V radius = load(given.radius);
    const Balls balls{load(given.x), load(given.y), Neg(load(given.z)), padded(radius, load(given.reach), roundoffs)};
    const M is_ball = And(radius > Zero(D()), FirstN(D(), left));
    const VU lights = BitCast(DU(), from_on(static_cast<std::int32_t>(given.lights.first + i)));
    append_balls(And(is_ball, reaches(balls)), balls, lights, out);
  }
  for (std::uint32_t i = begin; i < out.count; i += n) {
    const auto at = [&](const AlignedVector<float>& list) { return LoadU(D(), list.data() + i); };
    const CellRanges cells = cells_of(Balls{at(out.x), at(out.y), at(out.depth), at(out.radius)});
    write_cells(cells, out, [&](VI indices, AlignedVector<std::int32_t>& to) { StoreU(indices, DI(), to.data() + i); });
  }
}

}  // namespace clusterbench::assign::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
