#include "assign/cone/spot_rows.h"

#include <algorithm>
#include <array>

#include "assign/contract/lists.h"
#include "core/memory.h"

#define HWY_TARGET_INCLUDE "assign/cone/spot_rows.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target

#include "assign/cone/spot_slices-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign::HWY_NAMESPACE {
namespace {

// The extremes of a row: in its two tile planes and between them.
template <bool orthographic>
struct RowExtremes {
  Extremes<orthographic> outmost;
  Point middle;  // mean of some of these points, and therefore inside the spot

  HWY_INLINE RowExtremes(const Extremes<orthographic>& between, const PlaneExtremes<orthographic>& above, M has_above,
                         const PlaneExtremes<orthographic>& below)
      : outmost(between) {
    Point sum{Zero(D()), Zero(D()), Zero(D())};
    V count = Zero(D());
    const auto add = [&](M where, const PlaneExtremes<orthographic>& in_plane) {
      outmost.add(where, in_plane.low, Side::left);
      outmost.add(where, in_plane.high, Side::right);
      add_points(And(where, in_plane.exist()), in_plane, sum, count);
    };
    const M always = FirstN(D(), Lanes(D()));
    add(always, below);
    add(has_above, above);
    add_points(always, outmost, sum, count);
    middle = inverse(count) * sum;
  }

 private:
  template <class AnyExtremes>
  static HWY_INLINE void add_points(M where, const AnyExtremes& points, Point& sum, V& count) {
    sum = chosen(where, sum + (points.low.point() + points.high.point()), sum);
    count = count + IfThenElseZero(where, all(2.0f));
  }
};

// A vector of rows, with their guessed columns and the proofs of them.
template <bool orthographic>
class RowEnds {
 public:
  // `rows`: the rows in the slices of these spots.
  HWY_INLINE RowEnds(const RowPlanes& planes, const SpotsInSlices<orthographic>& spots, const SpotsInRows& rows,
                     const RowExtremes<orthographic>& found)
      : planes_(planes), spots_(spots), rows_(rows), found_(found), exist_(found.outmost.exist()) {
    const V left = all(planes.left), right = all(planes.right), scale = all(planes.columns_per_slope);
    const V low = found.outmost.low.across, high = found.outmost.high.across;
    const VI columns = all(planes.columns), last_column = columns - all(1);
    const auto column_at = [&](V slope) {
      const V at = (Min(Max(slope, left), right) - left) * scale;
      return Min(whole(Floor(at)), last_column);
    };
    const MI is_right = RebindMask(DI(), low > right), is_left = RebindMask(DI(), high < left);
    first_ = IfThenElse(is_right, columns, column_at(low));
    last_ = IfThenElse(is_left, all(-1), column_at(high));
    is_first_column_ = RebindMask(D(), first_ == Zero(DI()));
    is_last_column_ = RebindMask(D(), last_ == last_column);
    is_beside_view_ = RebindMask(D(), Or(is_right, is_left));
  }

  VI first() const { return first_; }
  VI last() const { return last_; }

  HWY_INLINE M none_before() const {
    return Or(is_first_column_, And(exist_, is_apart(found_.outmost.low, side(first_), all(-1.0f))));
  }
  HWY_INLINE M none_after() const {
    return Or(is_last_column_, And(exist_, is_apart(found_.outmost.high, side(last_ + all(1)), all(1.0f))));
  }
  HWY_INLINE M first_is_touched() const { return is_touched(first_); }
  HWY_INLINE M last_is_touched() const { return is_touched(Max(last_, Zero(DI()))); }
  // The whole row's part is left or right of the picture.
  HWY_INLINE M is_beside_view() const { return is_beside_view_; }

 private:
  HWY_INLINE V side(VI column) const { return gathered(planes_.side, column); }

  HWY_INLINE M is_apart(const ProjectedPoint<orthographic>& extreme, V boundary, V to_side) const {
    const V along_w = w_along<orthographic>(to_side * extreme.across);
    const Point p = extreme.point();
    const M in_slice_plane = Or(p.depth == rows_.depth0, p.depth == rows_.depth1);
    const Point edge = chosen(in_slice_plane, y_axis(), orthographic ? depth_axis() : p);
    const Point normal = touching_plane(spots_.shapes, p, edge, {to_side, Zero(D()), Neg(along_w)});
    return RegionBeyond<orthographic>{boundary, to_side, rows_.y0, rows_.y1, spots_.between}.is_apart(
        rows_.cone, normal, rows_.tolerance<orthographic>(boundary, boundary));
  }

  // Is there a common point near the line from an extreme point to the middle?
  HWY_INLINE M is_touched(VI column) const {
    const Point& middle = found_.middle;
    const V left = side(column), right = side(column + all(1));
    const V from = Max(left, found_.outmost.low.across), to = Min(right, found_.outmost.high.across);
    const V quarter = all(0.25f) * (to - from), amid = middle.x / w_of<orthographic>(middle.depth);
    const V slope = Max(from + quarter, Min(amid, to - quarter));
    const Point start = chosen(slope < amid, found_.outmost.low.point(), found_.outmost.high.point());
    const Point way = middle - start;
    const V span = way.x - slope * w_along<orthographic>(way.depth);
    const V part = slope * w_of<orthographic>(start.depth) - start.x;
    const V t = part / IfThenElse(span == Zero(D()), all(1.0f), span);
    const Point point = start + Min(Max(t, Zero(D())), all(1.0f)) * way;
    const CellTests<orthographic> cell(rows_, left, right);
    const M wanted = AndNot(is_beside_view_, exist_);
    Point v = cell.near_in_cell(point - rows_.cone.apex);
    M touched = cell.is_common(v);
    for (int again = 0; again < 3 && !AllTrue(D(), Or(touched, Not(wanted))); ++again) {
      v = cell.closer_to_volume(v);
      touched = Or(touched, cell.is_common(v));
    }
    return And(wanted, touched);
  }

  const RowPlanes& planes_;
  const SpotsInSlices<orthographic>& spots_;
  const SpotsInRows& rows_;
  const RowExtremes<orthographic>& found_;
  M exist_, is_first_column_, is_last_column_, is_beside_view_;
  VI first_, last_;
};

// Appends the rows of a block of spots in slices.
template <bool orthographic>
void rows_of(const RowPlanes& planes, const Table& slopes, const Slices<orthographic>& slices, SpotRows& out) {
  const hn::Rebind<std::uint8_t, DU> du8;
  const auto n = static_cast<std::int32_t>(Lanes(D()));
  const std::int32_t count = slices.list_rows(out);
  Carried carry;
  PlaneExtremes<orthographic> turned;
  VI turned_slice = all(-1);
  for (std::int32_t t = 0; t < count; t += n) {
    const VI in_slice = LoadU(DI(), out.listed_slice.data() + t), row = LoadU(DI(), out.listed_row.data() + t);
    const std::int32_t first_slice = GetLane(in_slice);
    const typename Slices<orthographic>::Lookup lookup{slices, first_slice,
                                                       IndicesFromVec(DI(), in_slice - all(first_slice))};
    const SpotsInSlices<orthographic> spots = lookup.spots();
    const VI above_row = Max(row, Zero(DI())), below_row = row + all(1);
    const V top = slopes.at(above_row), bottom = slopes.at(below_row);
    const PlaneExtremes<orthographic> below = spots.in_tile_plane(bottom);
    const PlaneExtremes<orthographic> above = below.carried(carry, turned, top);
    const M has_above = RebindMask(D(), carry(in_slice, turned_slice) == in_slice);
    const V room = spots.shapes.slack * spots.between.inverse_far;
    const RowExtremes<orthographic> found(lookup.between(bottom, top, room), above, has_above, below);
    const SpotsInRows rows{spots.shapes.cone, spots.light, bottom, top, spots.between.near, spots.between.far};
    const RowEnds<orthographic> ends(planes, spots, rows, found);
    const M in_range = fit_single_precision(planes, spots.light);
    const M none_before = And(in_range, ends.none_before()), none_after = And(in_range, ends.none_after());
    // No row, or proven to be beside the whole picture.
    const M is_out = Or(RebindMask(D(), row < Zero(DI())), And(ends.is_beside_view(), And(none_before, none_after)));
    const auto bit = [&](M where, std::uint8_t value) {
      return IfThenElseZero(RebindMask(DU(), where), all(std::uint32_t{value}));
    };
    const VU proven = Or(Or(bit(none_before, SpotRows::k_none_before), bit(none_after, SpotRows::k_none_after)),
                         Or(bit(And(in_range, ends.first_is_touched()), SpotRows::k_first_is_touched),
                            bit(And(in_range, ends.last_is_touched()), SpotRows::k_last_is_touched)));
    const std::uint32_t to = out.count + static_cast<std::uint32_t>(t);
    const auto store = [&](VI value, auto& list) {
      StoreU(BitCast(DU(), value), DU(), reinterpret_cast<std::uint32_t*>(list.data()) + to);
    };
    const MI out_lanes = RebindMask(DI(), is_out);
    store(lookup.spot(), out.spot);
    store(lookup.slice(), out.slice);
    store(row, out.row);
    store(IfThenElse(out_lanes, all(1), ends.first()), out.first);
    store(IfThenZeroElse(out_lanes, ends.last()), out.last);
    StoreU(U8FromU32(Or(proven, bit(is_out, SpotRows::k_all))), du8, out.proven.data() + to);
  }
  out.count += static_cast<std::uint32_t>(count);
}

template <bool orthographic>
void rows_of_all(const view::LightArrays& lights, const RowPlanes& planes, const SpotSlices& slices, SpotRows& out) {
  const Table slopes(planes.slope, planes.rows + 1);
  constexpr std::uint32_t k_most = Slices<orthographic>::k_most;
  for (std::uint32_t begin = 0; begin < slices.count; begin += k_most) {
    const std::uint32_t end = std::min(begin + k_most, slices.count);
    const Slices<orthographic> some(lights, planes, slopes, slices, begin, end);
    out.make_room(std::size_t{k_most} * static_cast<std::size_t>(planes.rows + 1));
    rows_of(planes, slopes, some, out);
  }
}

void spot_rows(const view::LightArrays& lights, const RowPlanes& planes, const SpotSlices& slices, SpotRows& out) {
  planes.orthographic ? rows_of_all<true>(lights, planes, slices, out)
                      : rows_of_all<false>(lights, planes, slices, out);
}

}  // namespace
}  // namespace clusterbench::assign::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(spot_rows);

void SpotSlices::make_room() {
  const std::size_t size = 2 * spot.size() + 4 * k_most_lanes;
  check_pair_count(size);
  check_memory("spots in slices", size, 2 * sizeof(std::uint32_t));
  grow_to(size, spot, slice);
}

// Makes room for this many more rows.
void SpotRows::make_room(std::size_t rows) {
  const std::size_t listed = rows + 2 * k_most_lanes, all = count + listed;
  check_pair_count(all);
  grow_to(listed, listed_slice, listed_row);
  if (proven.size() >= all) return;
  const std::size_t size = std::max(all, 2 * proven.size());
  check_memory("rows of spots", size, 5 * sizeof(std::uint32_t) + sizeof(std::uint8_t));
  grow_to(size, spot, slice, row, first, last, proven);
}

void find_spot_rows(const view::LightArrays& lights, const RowPlanes& planes, SpotSlices& slices, SpotRows& out) {
  out.count = 0;
  // A whole vector reads past the end: fill that part with valid indices.
  if (slices.count + k_most_lanes > slices.spot.size()) slices.make_room();
  for (std::vector<std::uint32_t>* list : {&slices.spot, &slices.slice})
    std::fill_n(list->begin() + slices.count, k_most_lanes, 0);
  HWY_DYNAMIC_DISPATCH(spot_rows)(lights, planes, slices, out);
}

}  // namespace clusterbench::assign
#endif
