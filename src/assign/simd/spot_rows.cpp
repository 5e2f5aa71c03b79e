#include "assign/simd/spot_rows.h"

#include <algorithm>
#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assign/simd/spot_rows.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target
#include <hwy/highway.h>

#include "assign/simd/spot_guess-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {
namespace {

// A vector of rows and what is guessed of them.
class Ends {
 public:
  HWY_INLINE Ends(const SpotsAndPlanes& from, const RowPlanes& planes, const SpotsInRows& rows, VI first, VI last,
                  const Extremes& found)
      : from_(from),
        planes_(planes),
        rows_(rows),
        outer_first_(first),
        outer_last_(last),
        found_(found),
        exists_(found_.exist()) {
    low_ = slope_of(found_.low);
    high_ = slope_of(found_.high);
    first_ = column_at(low_);
    last_ = column_at(high_);
  }

  VI first() const { return first_; }
  VI last() const { return last_; }

  HWY_INLINE M first_is_known() const {
    const M is_outmost = hn::RebindMask(D(), hn::Eq(first_, outer_first_)), touched = hn::And(exists_, touches(first_));
    return hn::And(touched, hn::Or(is_outmost, misses_before(hn::AndNot(is_outmost, touched))));
  }
  HWY_INLINE M last_is_known() const {
    const M is_outmost = hn::RebindMask(D(), hn::Eq(last_, outer_last_)), touched = hn::And(exists_, touches(last_));
    return hn::And(touched, hn::Or(is_outmost, misses_behind(hn::AndNot(is_outmost, touched))));
  }

  // Nothing was found within the columns.
  HWY_INLINE M found_none() const {
    const V left = side(outer_first_), right = side(hn::Add(outer_last_, all_int(1)));
    return hn::Or(hn::Not(exists_), hn::Or(hn::Lt(high_, left), hn::Gt(low_, right)));
  }

 private:
  HWY_INLINE static V slope_of(const Point& p) { return hn::Div(p.x, hn::Max(p.depth, all(1e-20f))); }
  HWY_INLINE V side(VI column) const { return gathered(from_.side, column); }

  HWY_INLINE VI column_at(V slope) const {
    const V at = hn::Mul(hn::Sub(slope, all(planes_.left)), all(planes_.columns_per_slope));
    const V most = all(static_cast<float>(planes_.columns));
    const VI column = hn::ConvertTo(DI(), hn::Floor(hn::Min(hn::Max(at, hn::Zero(D())), most)));
    return hn::Min(hn::Max(column, outer_first_), outer_last_);
  }

  // The place with this slope on the way from one extreme to the other.
  HWY_INLINE Point place_at(V slope) const {
    const Point way = found_.high - found_.low;
    const V whole = hn::Sub(way.x, hn::Mul(slope, way.depth));
    const V part = hn::Sub(hn::Mul(slope, found_.low.depth), found_.low.x);
    const V t = hn::Div(part, hn::IfThenElse(hn::Eq(whole, hn::Zero(D())), all(1.0f), whole));
    return found_.low + hn::Min(hn::Max(t, hn::Zero(D())), all(1.0f)) * way;
  }

  // Is there a common place near the way between the extremes?
  HWY_INLINE M touches(VI column) const {
    const V left = side(column), right = side(hn::Add(column, all_int(1)));
    const Cells cell(rows_, left, right);
    const V from = hn::Max(left, low_), to = hn::Min(right, high_);
    const V slope = hn::Add(from, hn::Mul(all(0.5f), hn::Sub(to, from)));
    Point v = cell.near_in_cell(place_at(slope) - rows_.cone.apex);
    M touched = cell.is_common(v);
    for (int way = 0; way < 2 && !hn::AllTrue(D(), hn::Or(touched, hn::Not(exists_))); ++way) {
      v = cell.closer_to_volume(v);
      touched = hn::Or(touched, cell.is_common(v));
    }
    return touched;
  }

  HWY_INLINE M misses_before(M wanted) const {
    const V boundary = side(first_), beyond = side(hn::Max(hn::Sub(first_, all_int(1)), hn::Zero(DI())));
    return misses(Cells(rows_, beyond, boundary), found_.low, {all(-1.0f), hn::Zero(D()), boundary}, wanted);
  }
  HWY_INLINE M misses_behind(M wanted) const {
    const VI next = hn::Add(last_, all_int(1));
    const V boundary = side(next), beyond = side(hn::Add(next, all_int(1)));
    return misses(Cells(rows_, boundary, beyond), found_.high, {all(1.0f), hn::Zero(D()), hn::Neg(boundary)}, wanted);
  }

  // Is there a plane between the spot and a cell, through the place of the spot that leans most towards it? The cone's
  // or the sphere's tangent plane, the tile plane itself, or one between the first two where the rim is what meets a
  // slice plane (upright) or a tile plane (through the eye).
  HWY_INLINE M misses(const Cells& cell, const Point& place, const Point& outward, M wanted) const {
    const Cone& cone = rows_.cone;
    const Point v = place - cone.apex;
    M apart = hn::Or(cell.is_beside(v), cell.is_past(outward));
    const auto is_done = [&] { return hn::AllTrue(D(), hn::Or(apart, hn::Not(wanted))); };
    if (is_done()) return apart;
    const Point generator = inverse(hn::Max(length(v), all(1e-20f))) * v, across = v - dot(v, cone.axis) * cone.axis;
    const Point side = hn::Div(cone.cosine, hn::Max(length(across), all(1e-20f))) * across - cone.sine * cone.axis;
    apart = hn::Or(apart, cell.is_past(generator));
    for (const Point& edge : {Point{hn::Zero(D()), all(1.0f), hn::Zero(D())}, place}) {
      if (is_done()) return apart;
      const V share = hn::Neg(hn::Div(dot(generator, edge), dot(side, edge)));
      apart = hn::Or(apart, hn::And(hn::Gt(share, hn::Zero(D())), cell.is_past(generator + share * side)));
    }
    return apart;
  }

  const SpotsAndPlanes& from_;
  const RowPlanes& planes_;
  const SpotsInRows& rows_;
  VI outer_first_, outer_last_;
  Extremes found_;
  M exists_;
  V low_, high_;
  VI first_, last_;
};

void ends_of_rows(const SpotsAndPlanes& from, const RowPlanes& planes, const SpotCells& rows, SpotRowEnds& out) {
  const D d;
  const DU du;
  const DI di;
  const hn::Rebind<std::uint8_t, DU> du8;
  const auto lanes = static_cast<std::uint32_t>(hn::Lanes(d));
  Guesses guesses;
  for (std::uint32_t first = 0; first < rows.count; first += lanes) {
    const VI spot = places(rows.spot, first), slice = places(rows.slice, first), row = places(rows.row, first);
    const VI column = places(rows.column, first), end_column = places(rows.end_column, first);
    const SpotsInRows these(from, spot, slice, row);
    const Extremes found =
        guesses.next(these, spot, slice, row, gathered(from.side, column), gathered(from.side, end_column));
    const Ends ends(from, planes, these, column, hn::Sub(end_column, all_int(1)), found);
    hn::StoreU(ends.first(), di, out.first.data() + first);
    hn::StoreU(ends.last(), di, out.last.data() + first);
    const auto bit = [&](M where, std::uint8_t value) {
      return hn::IfThenElseZero(hn::RebindMask(du, where), hn::Set(du, value));
    };
    const VU ends_known =
        hn::Or(bit(ends.first_is_known(), SpotRowEnds::k_first), bit(ends.last_is_known(), SpotRowEnds::k_last));
    const VU known = hn::Or(ends_known, bit(ends.found_none(), SpotRowEnds::k_found_none));
    hn::StoreU(hn::U8FromU32(known), du8, out.known.data() + first);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(ends_of_rows);

void SpotRowEnds::make_room(std::uint32_t rows) {
  const std::size_t size = rows + k_most_lanes;
  if (known.size() >= size) return;
  first.resize(size);
  last.resize(size);
  known.resize(size);
}

void find_ends(const SpotsAndPlanes& from, const RowPlanes& planes, SpotCells& rows, SpotRowEnds& ends) {
  rows.pad();
  ends.make_room(rows.count);
  HWY_DYNAMIC_DISPATCH(ends_of_rows)(from, planes, rows, ends);
}

}  // namespace clusterbench::assign
#endif
