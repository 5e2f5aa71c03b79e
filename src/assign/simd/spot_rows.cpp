#include "assign/simd/spot_rows.h"

#include <algorithm>
#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assign/simd/spot_rows.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target
#include <hwy/highway.h>

#include "assign/simd/plane_tables-inl.h"
#include "assign/simd/spot_places-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {
namespace {

// Outwards, of a plane that touches spots in a place of their surface; any length. In places of the rim one that holds
// the direction of an edge, between the sphere's tangent plane and that of the cone's side. At the apex, and where both
// of these hold the edge, one that is given.
HWY_INLINE Point touching_plane(const SpotShapes& spots, const Point& place, const Point& edge, const Point& given) {
  const Cone& cone = spots.cone;
  const Point v = place - cone.apex;
  const V square = dot(v, v), range_square = square_of(cone.range), along = dot(v, cone.axis);
  const Point part = v - along * cone.axis;
  const V across = length(part);
  const Point side = cone.cosine * part - hn::Mul(cone.sine, across) * cone.axis;
  const V off = hn::Max(spots.slack, hn::Mul(all(0x1p-12f), cone.range));  // what a place can be off by
  const M on_sphere = hn::Ge(square, square_of(hn::Sub(cone.range, off)));
  const V inwards = hn::Sub(hn::Mul(cone.sine, along), hn::Mul(cone.cosine, across));
  const M on_rim = hn::And(on_sphere, hn::Le(inwards, off));
  const V of_sphere = hn::Abs(dot(side, edge)), of_side = hn::Abs(dot(v, edge)), sum = hn::Add(of_sphere, of_side);
  const M is_held = hn::Lt(square_of(sum), hn::Mul(all(0x1p-20f), hn::Mul(range_square, dot(edge, edge))));
  const M at_apex = hn::Lt(square, square_of(spots.slack));
  const Point between = of_sphere * v + of_side * side;
  return chosen(hn::Or(at_apex, hn::And(on_rim, is_held)), given, chosen(on_rim, between, chosen(on_sphere, v, side)));
}

// All whose slope x / depth is beyond a boundary to one side (1 or -1), between two slice planes and two tile planes.
struct Beyond {
  V boundary, side;
  V up0, up1;
  const SlicePlanes& planes;

  // Is it apart from spots by a plane, given as its outward normal of any length? Where that has an x, it must be
  // outwards, so that nothing is nearer than the corners at the boundary.
  HWY_INLINE M is_apart(const Cone& cone, const Point& normal, V tolerance) const {
    const auto corner = [&](V up, V depth) {
      return dot(normal, Point{hn::Mul(boundary, depth), hn::Mul(up, depth), depth} - cone.apex);
    };
    const V least = hn::Min(hn::Min(corner(up0, planes.near), corner(up1, planes.near)),
                            hn::Min(corner(up0, planes.far), corner(up1, planes.far)));
    const V size = length(normal);
    const M is_apart = hn::Gt(hn::Sub(least, extent_of(cone, normal, size)), hn::Mul(tolerance, size));
    // Squares of much shorter ones lose digits.
    const M is_measured = hn::Gt(size, all(1e-10f));
    return hn::And(hn::And(is_apart, is_measured), hn::Ge(hn::Mul(normal.x, side), hn::Zero(D())));
  }
};

// Rows that spots in slices may touch.
struct RowsReached {
  VI first, count;
  MI with_top;  // what leans most in the first row may be in the picture's top
};

// A vector of spots in slices, and which rows they touch.
class Reached {
 public:
  HWY_INLINE Reached(const RowPlanes& planes, const PlaneTables& tables, const SpotShapes& spots,
                     const SlicePlanes& between, V light)
      : planes_(planes), tables_(tables), spots_(spots.exchanged()), between_(between), light_(light) {}

  HWY_INLINE RowsReached rows() const {
    Extremes found;
    Ups ups{found};
    each_place_in_slice(spots_, between_, ups);
    const V top = all(planes_.slope.front()), bottom = all(planes_.slope[static_cast<std::size_t>(planes_.rows)]);
    const V high = hn::Add(found.high.across, hn::Div(spots_.slack, found.high.depth));
    const V low = hn::Sub(found.low.across, hn::Div(spots_.slack, found.low.depth));
    const V scale = all(planes_.rows_per_slope), margin = all(planes_.row_margin), zero = hn::Zero(D());
    const VI none = hn::Zero(DI()), rows = all_int(planes_.rows), one = all_int(1), last_row = hn::Sub(rows, one);
    const V from = hn::Sub(hn::Mul(hn::Sub(top, hn::Min(high, top)), scale), margin);
    const V to = hn::Add(hn::Mul(hn::Sub(top, hn::Max(low, bottom)), scale), margin);
    const MI is_below = hn::RebindMask(DI(), hn::Lt(high, bottom)), is_above = hn::RebindMask(DI(), hn::Gt(low, top));
    VI first = hn::IfThenElse(is_below, rows, hn::Min(whole(hn::Floor(hn::Max(from, zero))), last_row));
    VI end = hn::IfThenElse(is_above, none, hn::Min(hn::Add(whole(hn::Floor(hn::Max(to, zero))), one), rows));
    const M exist = found.exist();
    const M none_above = hn::And(exist, is_apart(found.high, tables_.slope.at(first), all(1.0f)));
    const M none_below = hn::And(exist, is_apart(found.low, tables_.slope.at(end), all(-1.0f)));
    first = hn::IfThenElseZero(hn::RebindMask(DI(), none_above), first);
    end = hn::IfThenElse(hn::RebindMask(DI(), none_below), end, rows);
    end = hn::IfThenZeroElse(hn::RebindMask(DI(), misses_slice()), end);
    return {first, hn::Max(hn::Sub(end, first), none),
            hn::And(hn::Eq(first, none), hn::RebindMask(DI(), hn::Not(hn::Lt(high, top))))};
  }

 private:
  struct Ups {
    Extremes& found;
    HWY_INLINE void low(M where, const Place& p) { found.take_low(where, p); }
    HWY_INLINE void high(M where, const Place& p) { found.take_high(where, p); }
    HWY_INLINE void both(M where, const Place& p) { found.take(where, p); }
  };

  HWY_INLINE M is_apart(const Place& place, V boundary, V side) const {
    const V zero = hn::Zero(D()), one = all(1.0f);
    Point normal =
        touching_plane(spots_, place.point(), {zero, one, zero}, {side, zero, hn::Neg(hn::Mul(side, place.across))});
    normal.y = zero;  // rows are endless to both sides
    const V tolerance = tolerance_of(light_, between_.far, hn::Abs(boundary), zero);
    return Beyond{boundary, side, zero, zero, between_}.is_apart(spots_.cone, normal, tolerance);
  }

  HWY_INLINE M misses_slice() const {
    const V zero = hn::Zero(D()), one = all(1.0f), tolerance = tolerance_of(light_, between_.far, zero, zero);
    const V ahead = spots_.cone.apex.depth;
    const V farthest = hn::Add(ahead, extent_of(spots_.cone, {zero, zero, one}, one));
    const V nearest = hn::Sub(ahead, extent_of(spots_.cone, {zero, zero, hn::Neg(one)}, one));
    return hn::Or(hn::Gt(hn::Sub(between_.near, farthest), tolerance),
                  hn::Gt(hn::Sub(nearest, between_.far), tolerance));
  }

  const RowPlanes& planes_;
  const PlaneTables& tables_;
  SpotShapes spots_;  // x and y exchanged
  const SlicePlanes& between_;
  V light_;
};

// Spots in slices, field by field.
class Slices {
 public:
  static constexpr std::uint32_t k_most = 64;

  HWY_INLINE Slices(const SpotsAndPlanes& from, const RowPlanes& planes, const PlaneTables& tables,
                    const SpotSlices& slices, std::uint32_t begin, std::uint32_t end) {
    const D d;
    const DI di;
    const auto n = static_cast<std::uint32_t>(hn::Lanes(d));
    const float widest = std::max(std::abs(planes.left), std::abs(planes.right));
    const float highest =
        std::max(std::abs(planes.slope.front()), std::abs(planes.slope[static_cast<std::size_t>(planes.rows)]));
    for (std::uint32_t i = begin; i < end; i += n) {
      const VI spot = places(slices.spot, i), slice = places(slices.slice, i);
      const GivenSpots given(*from.lights, spot);
      const SlicePlanes between = {gathered(planes.depth, slice), gathered(planes.depth.data() + 1, slice),
                                   gathered(planes.inverse_depth, slice),
                                   gathered(planes.inverse_depth.data() + 1, slice)};
      const SpotShapes shapes(given.cone, tolerance_of(given.light, between.far, all(widest), all(highest)));
      const RowsReached rows = Reached(planes, tables, shapes, between, given.light).rows();
      SpotsInSlices in_slices(shapes, between, given.light);
      const MI wanted = hn::And(hn::Gt(rows.count, hn::Zero(di)), hn::FirstN(di, end - i));
      Writer writer{*this, wanted};
      in_slices.each([&](V& value) { writer.put(value); });
      Slots slots{writer};
      each_place_in_slice(shapes, between, slots);
      hn::StoreU(compressed(di, spot, wanted), di, spot_ + count_);
      hn::StoreU(compressed(di, slice, wanted), di, slice_ + count_);
      const VI lead = hn::IfThenElseZero(rows.with_top, all_int(1));
      hn::StoreU(compressed(di, hn::Sub(rows.first, lead), wanted), di, first_row_ + count_);
      hn::StoreU(compressed(di, hn::Add(rows.count, lead), wanted), di, row_count_ + count_);
      count_ += static_cast<std::int32_t>(hn::CountTrue(di, wanted));
    }
  }

  // Lists the rows. The first ones of a slice may be above the picture. Returns how many.
  HWY_INLINE std::int32_t list_rows(SpotRows& out) const {
    const DI di;
    const auto n = static_cast<std::int32_t>(hn::Lanes(di));
    std::int32_t count = 0;
    for (std::int32_t i = 0; i < count_; ++i) {
      // What is written beyond a slice's end, the next one overwrites.
      for (std::int32_t at = 0; at < row_count_[i]; at += n) {
        hn::StoreU(all_int(i), di, out.listed_slice.data() + count + at);
        hn::StoreU(from_on(first_row_[i] + at), di, out.listed_row.data() + count + at);
      }
      count += row_count_[i];
    }
    hn::StoreU(all_int(std::max(count_ - 1, 0)), di, out.listed_slice.data() + count);
    hn::StoreU(hn::Zero(di), di, out.listed_row.data() + count);
    return count;
  }

  // Looks up values of slices for rows: of those that are `which` lanes after the first one.
  struct Lookup {
    const Slices& slices;
    std::int32_t first;
    Which which;

    HWY_INLINE V operator()(int field) const { return taken(hn::LoadU(D(), slices.values_[field] + first), which); }
    HWY_INLINE SpotsInSlices spots() const {
      SpotsInSlices spots;
      int field = 0;
      spots.each([&](V& value) { value = (*this)(field++); });
      return spots;
    }
    HWY_INLINE VI spot() const { return taken(hn::LoadU(DI(), slices.spot_ + first), which); }
    HWY_INLINE VI slice() const { return taken(hn::LoadU(DI(), slices.slice_ + first), which); }

    // Of the places that can lean most, those between two tile planes, by and large.
    HWY_INLINE Extremes between(V bottom, V top, V room) const {
      Extremes found;
      const V low = hn::Sub(bottom, room), high = hn::Add(top, room);
      int field = SpotsInSlices::k_vectors;
      const auto each = [&](int count, auto&& take) {
        for (int i = 0; i < count; ++i, field += 3) {
          const Place p = {(*this)(field), (*this)(field + 1), (*this)(field + 2)};
          take(is_between(low, p.up, high), p);
        }
      };
      each(k_slots_in_slice.low, [&](M where, const Place& p) { found.take_low(where, p); });
      each(k_slots_in_slice.high, [&](M where, const Place& p) { found.take_high(where, p); });
      each(k_slots_in_slice.both, [&](M where, const Place& p) { found.take(where, p); });
      return found;
    }
  };

 private:
  static constexpr int k_fields =
      SpotsInSlices::k_vectors + 3 * (k_slots_in_slice.low + k_slots_in_slice.high + k_slots_in_slice.both);
  static constexpr std::size_t k_pitch = k_most + k_most_lanes;

  struct Writer {
    Slices& to;
    MI wanted;
    int field = 0;

    HWY_INLINE void put(V value) { put_at(field++, value); }
    HWY_INLINE void put_at(int at, V value) {
      hn::StoreU(compressed(D(), value, hn::RebindMask(D(), wanted)), D(), to.values_[at] + to.count_);
    }
  };
  // Places go to their own fields; those that do not exist are neither above nor below anything.
  struct Slots {
    Writer& writer;
    int next_low = SpotsInSlices::k_vectors, next_high = next_low + 3 * k_slots_in_slice.low,
        next_both = next_high + 3 * k_slots_in_slice.high;

    HWY_INLINE void low(M where, const Place& p) { put(next_low, where, p); }
    HWY_INLINE void high(M where, const Place& p) { put(next_high, where, p); }
    HWY_INLINE void both(M where, const Place& p) { put(next_both, where, p); }
    HWY_INLINE void put(int& next, M where, const Place& p) {
      writer.put_at(next++, p.across);
      writer.put_at(next++, hn::IfThenElse(where, p.up, all(std::numeric_limits<float>::quiet_NaN())));
      writer.put_at(next++, p.depth);
    }
  };

  std::int32_t count_ = 0;
  alignas(64) float values_[k_fields][k_pitch];
  std::int32_t spot_[k_pitch], slice_[k_pitch], first_row_[k_pitch], row_count_[k_pitch];
};

// What leans most in the tile planes of rows and between them.
struct RowExtremes {
  Extremes all;
  Point middle;  // of some of the places, and so within the spot

  HWY_INLINE RowExtremes(const Extremes& between, const PlaneExtremes& above, M has_above, V top,
                         const PlaneExtremes& below, V bottom)
      : all(between) {
    add(hn::FirstN(D(), hn::Lanes(D())), below, bottom);
    add(has_above, above, top);
    const V one = assign::HWY_NAMESPACE::all(1.0f), zero = hn::Zero(D());
    middle = all.low.point() + all.high.point();
    V count = hn::Add(one, one);
    const auto add_plane = [&](M where, const PlaneExtremes& plane, V slope) {
      const M exist = hn::And(where, plane.exist());
      const V low = hn::IfThenElseZero(exist, plane.low_depth), high = hn::IfThenElseZero(exist, plane.high_depth);
      middle = middle + low * Point{plane.low, slope, one} + high * Point{plane.high, slope, one};
      count = hn::Add(count, hn::IfThenElse(exist, hn::Add(one, one), zero));
    };
    add_plane(hn::FirstN(D(), hn::Lanes(D())), below, bottom);
    add_plane(has_above, above, top);
    middle = inverse(count) * middle;
  }

 private:
  HWY_INLINE void add(M where, const PlaneExtremes& plane, V slope) {
    all.take_low(where, {plane.low, slope, plane.low_depth});
    all.take_high(where, {plane.high, slope, plane.high_depth});
  }
};

// A vector of rows and what is guessed of them.
class Ends {
 public:
  // `rows`: their pieces of these spots' slices.
  HWY_INLINE Ends(const SpotsAndPlanes& from, const RowPlanes& planes, const SpotsInSlices& spots,
                  const SpotsInRows& rows, const RowExtremes& found)
      : from_(from), spots_(spots), rows_(rows), found_(found), exist_(found.all.exist()) {
    const V left = all(planes.left), right = all(planes.right), scale = all(planes.columns_per_slope);
    const V low = found.all.low.across, high = found.all.high.across;
    const VI columns = all_int(planes.columns), last_column = hn::Sub(columns, all_int(1));
    const auto column_at = [&](V slope) {
      const V at = hn::Mul(hn::Sub(hn::Min(hn::Max(slope, left), right), left), scale);
      return hn::Min(whole(hn::Floor(at)), last_column);
    };
    const MI is_right = hn::RebindMask(DI(), hn::Gt(low, right)), is_left = hn::RebindMask(DI(), hn::Lt(high, left));
    first_ = hn::IfThenElse(is_right, columns, column_at(low));
    last_ = hn::IfThenElse(is_left, all_int(-1), column_at(high));
    is_first_column_ = hn::RebindMask(D(), hn::Eq(first_, hn::Zero(DI())));
    is_last_column_ = hn::RebindMask(D(), hn::Eq(last_, last_column));
    is_aside_ = hn::RebindMask(D(), hn::Or(is_right, is_left));
  }

  VI first() const { return first_; }
  VI last() const { return last_; }

  HWY_INLINE M none_before() const {
    return hn::Or(is_first_column_, hn::And(exist_, is_apart(found_.all.low, side(first_), all(-1.0f))));
  }
  HWY_INLINE M none_behind() const {
    return hn::Or(is_last_column_,
                  hn::And(exist_, is_apart(found_.all.high, side(hn::Add(last_, all_int(1))), all(1.0f))));
  }
  HWY_INLINE M first_is_touched() const { return is_touched(first_); }
  HWY_INLINE M last_is_touched() const { return is_touched(hn::Max(last_, hn::Zero(DI()))); }
  // All is left or right of the picture.
  HWY_INLINE M is_aside() const { return is_aside_; }

 private:
  HWY_INLINE V side(VI column) const { return gathered(from_.side, column); }

  HWY_INLINE M is_apart(const Place& place, V boundary, V to_side) const {
    const V zero = hn::Zero(D()), one = all(1.0f);
    const Point p = place.point();
    const M in_slice_plane = hn::Or(hn::Eq(p.depth, rows_.depth0), hn::Eq(p.depth, rows_.depth1));
    const Point edge = chosen(in_slice_plane, {zero, one, zero}, p);
    const Point normal =
        touching_plane(spots_.spots, p, edge, {to_side, zero, hn::Neg(hn::Mul(to_side, place.across))});
    return Beyond{boundary, to_side, rows_.y0, rows_.y1, spots_.planes}.is_apart(rows_.cone, normal,
                                                                                 rows_.tolerance(boundary, boundary));
  }

  // Is there a common place near the way from an extreme to the middle?
  HWY_INLINE M is_touched(VI column) const {
    const Point& middle = found_.middle;
    const V left = side(column), right = side(hn::Add(column, all_int(1)));
    const V from = hn::Max(left, found_.all.low.across), to = hn::Min(right, found_.all.high.across);
    const V quarter = hn::Mul(all(0.25f), hn::Sub(to, from)), amid = hn::Div(middle.x, middle.depth);
    const V slope = hn::Max(hn::Add(from, quarter), hn::Min(amid, hn::Sub(to, quarter)));
    const Point start = chosen(hn::Lt(slope, amid), found_.all.low.point(), found_.all.high.point());
    const Point way = middle - start;
    const V span = hn::Sub(way.x, hn::Mul(slope, way.depth));
    const V part = hn::Sub(hn::Mul(slope, start.depth), start.x);
    const V t = hn::Div(part, hn::IfThenElse(hn::Eq(span, hn::Zero(D())), all(1.0f), span));
    const Point place = start + hn::Min(hn::Max(t, hn::Zero(D())), all(1.0f)) * way;
    const Cells cell(rows_, left, right);
    const M wanted = hn::AndNot(is_aside_, exist_);
    Point v = cell.near_in_cell(place - rows_.cone.apex);
    M touched = cell.is_common(v);
    for (int again = 0; again < 3 && !hn::AllTrue(D(), hn::Or(touched, hn::Not(wanted))); ++again) {
      v = cell.closer_to_volume(v);
      touched = hn::Or(touched, cell.is_common(v));
    }
    return hn::And(wanted, touched);
  }

  const SpotsAndPlanes& from_;
  const SpotsInSlices& spots_;
  const SpotsInRows& rows_;
  const RowExtremes& found_;
  M exist_, is_first_column_, is_last_column_, is_aside_;
  VI first_, last_;
};

// The rows of some spots in slices, to the end of what was found.
void rows_of(const SpotsAndPlanes& from, const RowPlanes& planes, const PlaneTables& tables, const Slices& slices,
             SpotRows& out) {
  const D d;
  const DI di;
  const DU du;
  const hn::Rebind<std::uint8_t, DU> du8;
  const auto n = static_cast<std::int32_t>(hn::Lanes(d));
  const std::int32_t count = slices.list_rows(out);
  Carried carry;
  PlaneExtremes turned;
  VI turned_slice = all_int(-1);
  for (std::int32_t t = 0; t < count; t += n) {
    const VI in_slice = hn::LoadU(di, out.listed_slice.data() + t), row = hn::LoadU(di, out.listed_row.data() + t);
    const std::int32_t first_slice = hn::GetLane(in_slice);
    const Slices::Lookup lookup{slices, first_slice, hn::IndicesFromVec(di, hn::Sub(in_slice, all_int(first_slice)))};
    const SpotsInSlices spots = lookup.spots();
    const VI above_row = hn::Max(row, hn::Zero(di)), below_row = hn::Add(row, all_int(1));
    const V top = tables.slope.at(above_row), bottom = tables.slope.at(below_row);
    const PlaneExtremes below =
        spots.in_tile_plane(bottom, tables.tilt.at(below_row), tables.inverse_tilt.at(below_row));
    const PlaneExtremes above = below.carried(carry, turned);
    const M has_above = hn::RebindMask(d, hn::Eq(carry(in_slice, turned_slice), in_slice));
    const V room = hn::Mul(spots.spots.slack, spots.planes.inverse_far);
    const RowExtremes found(lookup.between(bottom, top, room), above, has_above, top, below, bottom);
    const SpotsInRows rows{spots.spots.cone, spots.light, bottom, top, spots.planes.near, spots.planes.far};
    const Ends ends(from, planes, spots, rows, found);
    const M none_before = ends.none_before(), none_behind = ends.none_behind();
    // No row, or proven to be beside all of the picture.
    const M is_out = hn::Or(hn::RebindMask(d, hn::Lt(row, hn::Zero(di))),
                            hn::And(ends.is_aside(), hn::And(none_before, none_behind)));
    const auto bit = [&](M where, std::uint8_t value) {
      return hn::IfThenElseZero(hn::RebindMask(du, where), hn::Set(du, value));
    };
    const VU known =
        hn::Or(hn::Or(bit(none_before, SpotRows::k_none_before), bit(none_behind, SpotRows::k_none_behind)),
               hn::Or(bit(ends.first_is_touched(), SpotRows::k_first_is_touched),
                      bit(ends.last_is_touched(), SpotRows::k_last_is_touched)));
    const std::uint32_t to = out.count + static_cast<std::uint32_t>(t);
    const auto store = [&](VI value, auto& list) {
      hn::StoreU(hn::BitCast(du, value), du, reinterpret_cast<std::uint32_t*>(list.data()) + to);
    };
    const MI out_lanes = hn::RebindMask(di, is_out);
    store(lookup.spot(), out.spot);
    store(lookup.slice(), out.slice);
    store(row, out.row);
    store(hn::IfThenElse(out_lanes, all_int(1), ends.first()), out.first);
    store(hn::IfThenZeroElse(out_lanes, ends.last()), out.last);
    hn::StoreU(hn::U8FromU32(hn::Or(known, bit(is_out, SpotRows::k_all))), du8, out.known.data() + to);
  }
  out.count += static_cast<std::uint32_t>(count);
}

void spot_rows(const SpotsAndPlanes& from, const RowPlanes& planes, const SpotSlices& slices, SpotRows& out) {
  const PlaneTables tables(planes);
  for (std::uint32_t begin = 0; begin < slices.count; begin += Slices::k_most) {
    const std::uint32_t end = std::min(begin + Slices::k_most, slices.count);
    const Slices some(from, planes, tables, slices, begin, end);
    out.make_room(std::size_t{Slices::k_most} * static_cast<std::size_t>(planes.rows + 1));
    rows_of(from, planes, tables, some, out);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(spot_rows);

void SpotSlices::make_room() {
  const std::size_t size = 2 * spot.size() + 4 * k_most_lanes;
  spot.resize(size);
  slice.resize(size);
}

void SpotRows::add(const SpotCell& columns) {
  make_room(1);
  spot[count] = columns.spot;
  slice[count] = columns.slice;
  row[count] = columns.row;
  first[count] = static_cast<std::int32_t>(columns.column);
  last[count] = static_cast<std::int32_t>(columns.end_column) - 1;
  known[count++] = 0;
}

// For so many rows more.
void SpotRows::make_room(std::size_t rows) {
  const std::size_t listed = rows + 2 * k_most_lanes, all = count + listed;
  for (std::vector<std::int32_t>* list : {&listed_slice, &listed_row})
    if (list->size() < listed) list->resize(listed);
  if (known.size() >= all) return;
  const std::size_t size = std::max(all, 2 * known.size());
  for (std::vector<std::uint32_t>* list : {&spot, &slice, &row}) list->resize(size);
  for (std::vector<std::int32_t>* list : {&first, &last}) list->resize(size);
  known.resize(size);
}

void find_spot_rows(const SpotsAndPlanes& from, const RowPlanes& planes, SpotSlices& slices, SpotRows& out) {
  out.count = 0;
  // What a whole vector reads beyond the end must be places that exist.
  if (slices.count + k_most_lanes > slices.spot.size()) slices.make_room();
  for (std::vector<std::uint32_t>* list : {&slices.spot, &slices.slice})
    std::fill_n(list->begin() + slices.count, k_most_lanes, 0);
  HWY_DYNAMIC_DISPATCH(spot_rows)(from, planes, slices, out);
}

}  // namespace clusterbench::assign
#endif
