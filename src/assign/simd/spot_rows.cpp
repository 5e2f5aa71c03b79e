#include "assign/simd/spot_rows.h"

#include <algorithm>
#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assign/simd/spot_rows.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target
#include <hwy/highway.h>

#include "assign/simd/spot_cells-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {
namespace {

HWY_INLINE V root(V square) {
  return hn::Sqrt(hn::Max(square, hn::Zero(D())));
}
HWY_INLINE V square_of(V x) {
  return hn::Mul(x, x);
}
HWY_INLINE V inverse(V x) {
  return hn::Div(all(1.0f), x);
}
// The two places found so far that lean most.
struct Extremes {
  Point low, high;

  HWY_INLINE Extremes() : low{all(k_none), all(0.0f), all(1.0f)}, high{all(-k_none), all(0.0f), all(1.0f)} {}

  HWY_INLINE void take(M where, const Point& p) {
    const M is_lower = hn::And(where, hn::Lt(hn::Mul(p.x, low.depth), hn::Mul(low.x, p.depth)));
    const M is_higher = hn::And(where, hn::Gt(hn::Mul(p.x, high.depth), hn::Mul(high.x, p.depth)));
    low = chosen(is_lower, p, low);
    high = chosen(is_higher, p, high);
  }
  HWY_INLINE M exist() const { return hn::Lt(low.x, all(k_none)); }

 private:
  static constexpr float k_none = 1e15f;
};

// Where what spots have in their rows leans most: of all places where it can (spot_rows.h), those that are in spot and
// row, by and large. The row's faces are y = slope * depth and depths.
class Guess {
 public:
  // `left`, `right`: sides of the columns that may be touched.
  HWY_INLINE Guess(const SpotsInRows& rows, V left, V right)
      : cone_(rows.cone),
        y0_(rows.y0),
        y1_(rows.y1),
        depth0_(rows.depth0),
        depth1_(rows.depth1),
        slack_(rows.tolerance(left, right)) {
    longest_square_ = square_of(hn::Add(cone_.range, slack_));
    range_square_ = hn::Mul(cone_.range, cone_.range);
    cosine_square_ = square_of(cone_.cosine);
    const Point toward = Point{all(0.3f), all(0.5f), all(0.8f)}, aside = Point{all(0.8f), all(-0.5f), all(0.1f)};
    const V along = dot(toward, cone_.axis);
    const M is_good = hn::Lt(hn::Abs(along), all(0.9f));
    const Point from = chosen(is_good, toward, aside);
    const Point part = from - dot(from, cone_.axis) * cone_.axis;
    m1_ = inverse(length(part)) * part;
    m2_ = cross(cone_.axis, m1_);
    rim_ = cone_.apex + hn::Mul(cone_.range, cone_.cosine) * cone_.axis;
    rim1_ = hn::Mul(cone_.range, cone_.sine) * m1_;
    rim2_ = hn::Mul(cone_.range, cone_.sine) * m2_;
    take_side();
    take_sphere();
  }

  const Extremes& extremes() const { return extremes_; }

 private:
  HWY_INLINE M is_between_slices(V depth) const {
    return is_between(hn::Sub(depth0_, slack_), depth, hn::Add(depth1_, slack_));
  }
  HWY_INLINE M is_between_tiles(V y, V depth) const {
    return is_between(hn::Sub(hn::Mul(y0_, depth), slack_), y, hn::Add(hn::Mul(y1_, depth), slack_));
  }
  // A place so far along the axis from the apex, and so far from the apex, squared.
  HWY_INLINE M is_in_cone(V along, V square) const {
    const V side = hn::Add(hn::Mul(cone_.sine, along), slack_), across = hn::Sub(square, square_of(along));
    return hn::And(hn::Ge(side, hn::Zero(D())), hn::Ge(square_of(side), hn::Mul(cosine_square_, across)));
  }
  HWY_INLINE M is_sphere_in_cone(const Point& p) const {
    return is_in_cone(dot(p - cone_.apex, cone_.axis), range_square_);
  }

  // Angles phi with a cos phi + b sin phi = c, as places of the rim.
  template <class Take>
  HWY_INLINE void each_rim_place(V a, V b, V c, Take&& take) const {
    const V square = hn::Add(square_of(a), square_of(b)), rest = hn::Sub(square, square_of(c));
    const M exists = hn::And(hn::Ge(rest, hn::Zero(D())), hn::Gt(square, hn::Zero(D())));
    const V w = root(rest), scale = inverse(square);
    for (const V sign : {all(1.0f), all(-1.0f)}) {
      const V turned = hn::Mul(sign, w);
      const V cosine = hn::Mul(scale, hn::Sub(hn::Mul(a, c), hn::Mul(b, turned)));
      const V sine = hn::Mul(scale, hn::Add(hn::Mul(b, c), hn::Mul(a, turned)));
      take(exists, rim_ + cosine * rim1_ + sine * rim2_);
    }
  }

  // The tangents from the eye to a circle around (across, ahead) with this radius, squared, as (across, ahead).
  template <class Take>
  HWY_INLINE static void each_tangent(V across, V ahead, V rho_square, Take&& take) {
    const V square = hn::Add(square_of(across), square_of(ahead)), tangent_square = hn::Sub(square, rho_square);
    const M exists = hn::And(hn::Ge(rho_square, hn::Zero(D())), hn::Gt(tangent_square, hn::Zero(D())));
    const V scale = inverse(square), turn = hn::Mul(scale, root(hn::Mul(rho_square, tangent_square)));
    const V shrink = hn::Mul(scale, tangent_square);
    for (const V sign : {all(1.0f), all(-1.0f)}) {
      const V turned = hn::Mul(sign, turn);
      take(exists, hn::Sub(hn::Mul(shrink, across), hn::Mul(turned, ahead)),
           hn::Add(hn::Mul(shrink, ahead), hn::Mul(turned, across)));
    }
  }

  // Where sphere and rim lean most.
  HWY_INLINE void take_free() {
    const Point& a = cone_.apex;
    each_tangent(a.x, a.depth, range_square_, [&](M exists, V x, V depth) {
      const Point p = {x, a.y, depth};
      const M is_in = hn::And(hn::And(is_between_slices(depth), is_between_tiles(p.y, depth)), is_sphere_in_cone(p));
      extremes_.take(hn::And(exists, is_in), p);
    });
    const auto wedge = [](V a1, V b1, V a2, V b2) { return hn::Sub(hn::Mul(a1, b2), hn::Mul(a2, b1)); };
    each_rim_place(wedge(rim2_.x, rim2_.depth, rim_.x, rim_.depth), wedge(rim_.x, rim_.depth, rim1_.x, rim1_.depth),
                   wedge(rim1_.x, rim1_.depth, rim2_.x, rim2_.depth), [&](M exists, const Point& p) {
                     const M is_in = hn::And(is_between_slices(p.depth), is_between_tiles(p.y, p.depth));
                     extremes_.take(hn::And(exists, is_in), p);
                   });
  }

  // Where sphere and rim lean most in a tile plane.
  HWY_INLINE void take_in_tile_plane(V slope) {
    const Point& a = cone_.apex;
    const V shrink = inverse(hn::Add(all(1.0f), square_of(slope)));  // of squares
    const V away = hn::Sub(a.y, hn::Mul(slope, a.depth));
    const V ahead = hn::Mul(shrink, hn::Add(hn::Mul(slope, a.y), a.depth));  // in depth
    const V tilt = hn::Sqrt(hn::Add(all(1.0f), square_of(slope)));
    const V rho_square = hn::Sub(range_square_, hn::Mul(shrink, square_of(away)));
    each_tangent(a.x, hn::Mul(tilt, ahead), rho_square, [&](M exists, V x, V along) {
      const V depth = hn::Mul(along, hn::Mul(tilt, shrink));
      const Point p = {x, hn::Mul(slope, depth), depth};
      extremes_.take(hn::And(exists, hn::And(is_between_slices(depth), is_sphere_in_cone(p))), p);
    });
    const auto part = [&](const Point& p) { return hn::Sub(p.y, hn::Mul(slope, p.depth)); };
    each_rim_place(part(rim1_), part(rim2_), hn::Neg(part(rim_)),
                   [&](M exists, const Point& p) { extremes_.take(hn::And(exists, is_between_slices(p.depth)), p); });
  }

  HWY_INLINE void take_in_slice_plane(V depth) {
    const Point& a = cone_.apex;
    const V ahead = hn::Sub(depth, a.depth), square = hn::Sub(range_square_, square_of(ahead));
    take_sphere_at(hn::And(hn::Ge(square, hn::Zero(D())), is_between_tiles(a.y, depth)), root(square), hn::Zero(D()),
                   ahead);
    each_rim_place(rim1_.depth, rim2_.depth, hn::Sub(depth, rim_.depth), [&](M on_rim, const Point& p) {
      extremes_.take(hn::And(on_rim, is_between_tiles(p.y, p.depth)), p);
    });
  }

  // The generators in which planes through the apex that hold a direction touch the cone.
  template <class Take>
  HWY_INLINE void each_generator(const Point& direction, Take&& take) const {
    const V along = dot(direction, cone_.axis), a = dot(direction, m1_), b = dot(direction, m2_);
    const V square = hn::Add(square_of(a), square_of(b));
    const V c = hn::Mul(hn::Div(cone_.sine, hn::Max(cone_.cosine, all(1e-6f))), along);
    const V rest = hn::Sub(square, square_of(c));
    const M exists = hn::And(hn::Ge(rest, hn::Zero(D())), hn::Gt(square, hn::Zero(D())));
    const V w = root(rest), scale = hn::Mul(cone_.sine, inverse(square));
    for (const V sign : {all(1.0f), all(-1.0f)}) {
      const V turned = hn::Mul(sign, w);
      const V to1 = hn::Mul(scale, hn::Sub(hn::Mul(a, c), hn::Mul(b, turned)));
      const V to2 = hn::Mul(scale, hn::Add(hn::Mul(b, c), hn::Mul(a, turned)));
      take(exists, cone_.cosine * cone_.axis + to1 * m1_ + to2 * m2_);
    }
  }

  // Where the cone's side leans most in tile planes (tangent planes through the eye) and in slice planes (upright
  // ones).
  HWY_INLINE void take_generators() {
    const Point& a = cone_.apex;
    const V zero = hn::Zero(D());
    const auto is_on = [&](V t) { return is_between(zero, t, hn::Add(cone_.range, slack_)); };
    each_generator(a, [&](M exists, const Point& g) {
      for (const V slope : {y0_, y1_}) {
        const V t = hn::Div(hn::Sub(hn::Mul(slope, a.depth), a.y), hn::Sub(g.y, hn::Mul(slope, g.depth)));
        const Point p = a + t * g;
        extremes_.take(hn::And(exists, hn::And(is_on(t), is_between_slices(p.depth))), p);
      }
    });
    each_generator({zero, all(1.0f), zero}, [&](M exists, const Point& g) {
      const V scale = inverse(g.depth);
      for (const V depth : {depth0_, depth1_}) {
        const V t = hn::Mul(hn::Sub(depth, a.depth), scale);
        const Point p = a + t * g;
        extremes_.take(hn::And(exists, hn::And(is_on(t), is_between_tiles(p.y, p.depth))), p);
      }
    });
  }

  // Calls take(up, ahead) for the row's four edges, seen from the apex.
  template <class Take>
  HWY_INLINE void each_edge(Take&& take) const {
    for (const V slope : {y0_, y1_})
      for (const V depth : {depth0_, depth1_})
        take(hn::Sub(hn::Mul(slope, depth), cone_.apex.y), hn::Sub(depth, cone_.apex.depth));
  }

  // Apex and side.
  HWY_INLINE void take_side() {
    const Point& a = cone_.apex;
    extremes_.take(hn::And(is_between_slices(a.depth), is_between_tiles(a.y, a.depth)), a);
    take_generators();
    each_edge([&](V up, V ahead) { take_side_on_edge(up, ahead); });
  }

  // Sphere and rim.
  HWY_INLINE void take_sphere() {
    take_free();
    for (const V slope : {y0_, y1_}) take_in_tile_plane(slope);
    for (const V depth : {depth0_, depth1_}) take_in_slice_plane(depth);
    each_edge([&](V up, V ahead) {
      const V square = hn::Sub(range_square_, hn::Add(square_of(up), square_of(ahead)));
      take_sphere_at(hn::Ge(square, hn::Zero(D())), root(square), up, ahead);
    });
  }

  // Places of the sphere as far to the right and to the left of the apex.
  HWY_INLINE void take_sphere_at(M where, V half, V up, V ahead) {
    const V k = hn::Add(hn::Mul(up, cone_.axis.y), hn::Mul(ahead, cone_.axis.depth));
    for (const V x : {half, hn::Neg(half)}) {
      const M is_in = is_in_cone(hn::Add(hn::Mul(x, cone_.axis.x), k), range_square_);
      extremes_.take(hn::And(where, is_in), cone_.apex + Point{x, up, ahead});
    }
  }

  // along² = cosine² (x² + rest), along = x axis.x + k.
  HWY_INLINE void take_side_on_edge(V up, V ahead) {
    const V rest = hn::Add(square_of(up), square_of(ahead));
    const V k = hn::Add(hn::Mul(up, cone_.axis.y), hn::Mul(ahead, cone_.axis.depth));
    const V qa = hn::Sub(square_of(cone_.axis.x), cosine_square_), qb = hn::Mul(k, cone_.axis.x);
    const V qc = hn::Sub(square_of(k), hn::Mul(cosine_square_, rest));
    const V inside = hn::Sub(square_of(qb), hn::Mul(qa, qc));
    const M exist = hn::Ge(inside, hn::Zero(D()));
    const V q = hn::Neg(hn::Add(qb, hn::CopySign(root(inside), qb)));
    for (const V x : {hn::Div(q, qa), hn::Div(qc, q)}) {
      const M is_in = hn::And(hn::Ge(hn::Add(hn::Mul(x, cone_.axis.x), k), hn::Neg(slack_)),
                              hn::Le(hn::Add(square_of(x), rest), longest_square_));
      extremes_.take(hn::And(exist, is_in), cone_.apex + Point{x, up, ahead});
    }
  }

  Cone cone_;
  V y0_, y1_, depth0_, depth1_, slack_, longest_square_, range_square_, cosine_square_;
  Point m1_, m2_;            // across the axis
  Point rim_, rim1_, rim2_;  // its middle, and from there to two of its places
  Extremes extremes_;
};

// A vector of rows and what is guessed of them.
class Ends {
 public:
  HWY_INLINE Ends(const SpotsAndPlanes& from, const RowPlanes& planes, const SpotsInRows& rows, VI first, VI last)
      : from_(from),
        planes_(planes),
        rows_(rows),
        outer_first_(first),
        outer_last_(last),
        found_(Guess(rows, gathered(from.side, first), gathered(from.side, hn::Add(last, all_int(1)))).extremes()),
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
  // A plane tells that there is nothing.
  HWY_INLINE M misses_all() const {
    return Cells(rows_, side(outer_first_), side(hn::Add(outer_last_, all_int(1)))).is_apart();
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
  for (std::uint32_t first = 0; first < rows.count; first += lanes) {
    const SpotsInRows these(from, places(rows.spot, first), places(rows.slice, first), places(rows.row, first));
    const Ends ends(from, planes, these, places(rows.column, first),
                    hn::Sub(places(rows.end_column, first), all_int(1)));
    hn::StoreU(ends.first(), di, out.first.data() + first);
    hn::StoreU(ends.last(), di, out.last.data() + first);
    const auto bit = [&](M where, std::uint8_t value) {
      return hn::IfThenElseZero(hn::RebindMask(du, where), hn::Set(du, value));
    };
    const VU ends_known =
        hn::Or(bit(ends.first_is_known(), SpotRowEnds::k_first), bit(ends.last_is_known(), SpotRowEnds::k_last));
    const M found_none = ends.found_none();
    VU known = hn::Or(ends_known, bit(found_none, SpotRowEnds::k_found_none));
    if (!hn::AllFalse(d, found_none))
      known = hn::Or(known, bit(hn::And(found_none, ends.misses_all()), SpotRowEnds::k_none));
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
