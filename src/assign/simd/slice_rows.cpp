#include "assign/simd/slice_rows.h"

#include <algorithm>
#include <cmath>

#include "assign/simd/flat_rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assign/simd/slice_rows.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target
#include <hwy/highway.h>

#include "assign/simd/batch_rows-inl.h"
#include "assign/simd/plane_tables-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {
namespace {

// The interval of slopes found so far, per lane.
struct Hull {
  V low, high;

  HWY_INLINE void add_low(M where, V value) { low = hn::IfThenElse(where, hn::Min(low, value), low); }
  HWY_INLINE void add_high(M where, V value) { high = hn::IfThenElse(where, hn::Max(high, value), high); }
  HWY_INLINE void add(M where, V least, V greatest) {
    add_low(where, least);
    add_high(where, greatest);
  }
  HWY_INLINE void add(const Hull& other) {
    low = hn::Min(low, other.low);
    high = hn::Max(high, other.high);
  }
  HWY_INLINE Hull of(Which which) const { return {taken(low, which), taken(high, which)}; }
};

HWY_INLINE Hull empty_hull() {
  return {infinity(), hn::Neg(infinity())};
}

// The tangents from the eye (the origin) to a circle around (across, ahead), as far as they touch it between two depths
// ahead. Depth ahead of a touch point = tangent * lean / square, slope = up / lean.
struct Tangents {
  M low_is_in, high_is_in;
  V low, high;                      // slopes; anything where not in
  V low_depth, high_depth, square;  // depths ahead, times square
};

// `tangent`: how far the touch points are from the eye, 0 if it is inside.
HWY_INLINE Tangents tangents_of(V across, V ahead, V rho, V tangent, V near, V far) {
  const V square = hn::Add(hn::Mul(across, across), hn::Mul(ahead, ahead));
  const V a = hn::Mul(ahead, tangent), b = hn::Mul(across, rho), c = hn::Mul(across, tangent), e = hn::Mul(ahead, rho);
  const V low_lean = hn::Add(a, b), high_lean = hn::Sub(a, b), from = hn::Mul(near, square), to = hn::Mul(far, square);
  const M exist = hn::Gt(tangent, hn::Zero(D()));
  Tangents tangents;
  tangents.low_depth = hn::Mul(tangent, low_lean);
  tangents.high_depth = hn::Mul(tangent, high_lean);
  tangents.square = square;
  tangents.low_is_in = hn::And(exist, is_between(from, tangents.low_depth, to));
  tangents.high_is_in = hn::And(exist, is_between(from, tangents.high_depth, to));
  // One division for both. The products stay in range for the reaches that see() lets through.
  const V low_by = hn::IfThenElse(tangents.low_is_in, low_lean, all(1.0f));
  const V high_by = hn::IfThenElse(tangents.high_is_in, high_lean, all(1.0f));
  const V inverse = hn::Div(all(1.0f), hn::Mul(low_by, high_by));
  tangents.low = hn::Mul(hn::Mul(hn::Sub(c, e), high_by), inverse);
  tangents.high = hn::Mul(hn::Mul(hn::Add(c, e), low_by), inverse);
  return tangents;
}

// One of the slice's two planes.
struct SlicePlane {
  float depth, inverse;
};

// Balls as a tile plane wants them, one per lane.
struct PlaneBalls {
  V x, y, depth, radius;
  V tangent;                  // from the eye to where its tangents touch, the same in all planes through the eye
  V near_square, far_square;  // half chords of the circles that the slice's planes cut out, squared
};

// What rows have of their balls: the extremes at the centre's own height. Where there are none, an empty hull.
struct LevelBalls {
  V y, y_square;
  V least_area;  // for rows straight ahead
  V rate;        // the most columns that a metre to the side can be
  Hull near_chord, far_chord;
  V low, high, low_depth,
      high_depth;  // the sphere's tangents; the depths at which they touch, as y_square times square
};

// The rows that balls may touch, and how many planes above the first and below the last one they may touch: those of
// the picture's ends, or none.
struct BallRows {
  VI first, count, planes_above, planes_below;
  VI held;  // all bits of those that hold all of the slice's part of the view: all columns of all rows are theirs
};

// Rows of one batch. Rows lie between tile planes; a plane's hull belongs to the row above it and to the one below.
class Batch {
 public:
  Batch() = default;
  HWY_INLINE Batch(const RowPlanes& planes, const SeenBalls& seen, const BallsOfSlice& balls) : planes_(&planes) {
    const VI at = hn::BitCast(DI(), hn::LoadU(DU(), balls.places));
    const Fours sphere = gathered_fours(seen.interleaved.data(), balls.places);
    balls_.x = sphere.first;
    balls_.y = sphere.second;
    balls_.depth = sphere.third;
    balls_.radius = sphere.fourth;
    slack_ = gathered(seen.slack, at);
    const auto k = static_cast<std::size_t>(balls.slice);
    near_ = {planes.depth[k], planes.inverse_depth[k]};
    far_ = {planes.depth[k + 1], planes.inverse_depth[k + 1]};
    balls_.near_square = chord_square(near_);
    balls_.far_square = chord_square(far_);
    near_half_ = root(balls_.near_square);
    far_half_ = root(balls_.far_square);
    lights_ = hn::GatherIndex(DU(), seen.light.data(), at);
    start_rows();
  }

  VU lights() const { return lights_; }

  // The rows that each ball may touch, from its extremes y / depth. `wanted`: the lanes that hold a ball.
  HWY_INLINE BallRows find_rows(M wanted) const {
    const Sphere sphere = sphere_along(balls_.y);
    const V high = hn::Max(hn::Max(sphere.near_chord.high, sphere.far_chord.high), sphere.high());
    const V low = hn::Min(hn::Min(sphere.near_chord.low, sphere.far_chord.low), sphere.low());
    const V top = all(planes_->slope.front()), bottom = all(planes_->slope[static_cast<std::size_t>(planes_->rows)]);
    const M is_level = hn::And(hn::Le(low, hn::Min(high, top)), hn::Ge(high, bottom));
    const M touches = hn::And(hn::And(wanted, is_level), touches_sides());
    const V scale = all(planes_->rows_per_slope), margin = all(planes_->row_margin), zero = hn::Zero(D());
    const V from = hn::Sub(hn::Mul(hn::Sub(top, hn::Min(high, top)), scale), margin);
    const V to = hn::Add(hn::Mul(hn::Sub(top, hn::Max(low, bottom)), scale), margin);
    const VI last_row = all_int(planes_->rows - 1);
    const VI held = hn::VecFromMask(DI(), hn::RebindMask(DI(), hn::And(wanted, holds_view())));
    const VI first = hn::Min(whole(hn::Floor(hn::Max(from, zero))), last_row);
    const VI last = hn::Min(whole(hn::Floor(hn::Max(to, zero))), last_row);
    const MI touches_rows = hn::RebindMask(DI(), touches);
    const V whole = hn::Mul(hn::Sub(top, bottom), scale);  // the last row may be clipped
    const VI one = all_int(1);
    const VI count = hn::IfThenElseZero(touches_rows, hn::Add(hn::Sub(last, first), one));
    return {hn::AndNot(held, first), hn::Or(hn::AndNot(held, count), hn::And(held, all_int(planes_->rows))),
            hn::IfThenElseZero(hn::And(touches_rows, hn::RebindMask(DI(), hn::Lt(from, zero))), one),
            hn::IfThenElseZero(hn::And(touches_rows, hn::RebindMask(DI(), hn::Ge(to, whole))), one), held};
  }

  // All columns of the held ones, none of others.
  HWY_INLINE VU columns_of_held(VI held) const {
    const VU all_columns = hn::Set(DU(), ColumnSpan::of(0, static_cast<std::uint32_t>(planes_->columns) - 1));
    return hn::Or(hn::And(hn::BitCast(DU(), held), all_columns), hn::Not(hn::BitCast(DU(), held)));
  }

  // What lies in tile plane `place` of the balls in which[i], between the slice's planes.
  HWY_INLINE Hull plane_hull(Which which, const PlaneTables& tables, VI place) const {
    const PlaneBalls ball = {taken(balls_.x, which),         taken(balls_.y, which),
                             taken(balls_.depth, which),     taken(balls_.radius, which),
                             taken(balls_.tangent, which),   taken(balls_.near_square, which),
                             taken(balls_.far_square, which)};
    const V slope = tables.slope.at(place), tilt = tables.tilt.at(place), inverse = tables.inverse_tilt.at(place);
    const V away = hn::Mul(hn::Sub(ball.y, hn::Mul(slope, ball.depth)), inverse);
    const V ahead = hn::Mul(hn::Add(hn::Mul(slope, ball.y), ball.depth), inverse);
    const V square = hn::Mul(hn::Sub(ball.radius, away), hn::Add(ball.radius, away));
    const M cuts = hn::Ge(square, hn::Zero(D()));
    Hull hull = empty_hull();
    const Tangents tangents = tangents_of(ball.x, ahead, root(square), ball.tangent, hn::Mul(all(near_.depth), tilt),
                                          hn::Mul(all(far_.depth), tilt));
    hull.add_low(hn::And(cuts, tangents.low_is_in), hn::Mul(tilt, tangents.low));
    hull.add_high(hn::And(cuts, tangents.high_is_in), hn::Mul(tilt, tangents.high));
    const auto add_corners = [&](const SlicePlane& plane, V chord) {
      const V up = hn::Sub(hn::Mul(slope, all(plane.depth)), ball.y);
      const V of_chord = hn::Sub(chord, hn::Mul(up, up));
      add_chord(plane, ball.x, of_chord, root(of_chord), hull);
    };
    add_corners(near_, ball.near_square);
    add_corners(far_, ball.far_square);
    return hull;
  }

  // Adds the sphere's own extremes at the centre's height, where that is between two tile planes.
  HWY_INLINE void add_level(Which which, V top, V bottom, Hull& hull) const {
    const auto is_level = [&](V y, V depth) { return is_between(hn::Mul(bottom, depth), y, hn::Mul(top, depth)); };
    const V y = taken(level_.y, which), y_square = taken(level_.y_square, which);
    const Hull near_chord = level_.near_chord.of(which), far_chord = level_.far_chord.of(which);
    hull.add(is_level(y, all(near_.depth)), near_chord.low, near_chord.high);
    hull.add(is_level(y, all(far_.depth)), far_chord.low, far_chord.high);
    hull.add_low(is_level(y_square, taken(level_.low_depth, which)), taken(level_.low, which));
    hull.add_high(is_level(y_square, taken(level_.high_depth, which)), taken(level_.high, which));
  }

  // Certainty. The hull is that of a ball between the given one and the given one with twice the slack, d. Let m be the
  // row's point nearest to the centre, g away, and w = sqrt(R² - g²) for the larger radius R. A point p of the larger
  // ball in the row is within w of m; moved towards m by the share d / (R - g) of that it is in the given ball, and
  // still in the row (here its part in the picture). That is d w / (R - g) = d (R + g) / w <= 2 d R / w far. From a
  // point of slope s on, a metre is at most q = sqrt(1 + s²) / near of slope, where no point of the larger ball in the
  // slice is nearer in depth than `near`, so the given ball's extremes are within e = 2 d R q / w of the hull's, and
  // the hull's width in the picture, h, is at most 2 w q; so e <= 4 d R q² / h. The
  // columns are certainly right if the hull's ends are farther than e from the next boundary inwards: that is, if that
  // distance times h is at least 4 d R q² = 8 slack R q², in columns the `least_area`. And the given ball reaches the
  // row at all if R - g >= d, which follows from h² >= 8 d R q².
  // Large balls near the eye are far wider than the picture, and h says little of w. For them any place in the row
  // does instead of m: it is no nearer, so its w is no larger. The columns are certain if the way inwards is at least
  // 2 d R q / w, and the ball reaches the row if w² >= 2 d R.
  HWY_INLINE VU columns_of(Which which, V top, V bottom, const Hull& hull, M wanted) const {
    return columns_between(
        *planes_, hull.low, hull.high, wanted, taken(level_.least_area, which),
        [](V low, V high) { return hn::Add(all(1.0f), hn::Max(hn::Mul(low, low), hn::Mul(high, high))); },
        [&](V inwards, V steepness) {
          const V radius = taken(balls_.radius, which), slack = taken(slack_, which);
          return is_certain_by_chord(half_chord_square(which, top, bottom), inwards, radius, slack,
                                     taken(level_.rate, which), steepness);
        });
  }

 private:
  // Do the sphere's own extremes, which lie no further in than those of any row, leave some of it between the picture's
  // sides?
  HWY_INLINE M touches_sides() const {
    const V low = hn::Min(hn::Min(level_.near_chord.low, level_.far_chord.low), level_.low);
    const V high = hn::Max(hn::Max(level_.near_chord.high, level_.far_chord.high), level_.high);
    return hn::And(hn::Le(low, all(planes_->right)), hn::Ge(high, all(planes_->left)));
  }
  HWY_INLINE M holds_view() const { return hn::Eq(level_.least_area, hn::Zero(D())); }

  HWY_INLINE void start_rows() {
    balls_.tangent = tangent_from_eye(hn::Add(hn::Mul(balls_.x, balls_.x), hn::Mul(balls_.y, balls_.y)));
    const Sphere sphere = sphere_along(balls_.x);
    const Tangents& tangents = sphere.tangents;
    const V nearest = hn::Max(all(near_.depth), hn::Sub(balls_.depth, hn::Add(balls_.radius, slack_)));
    const V rate = hn::Div(all(planes_->columns_per_slope), nearest);
    level_ = {balls_.y,
              hn::Mul(balls_.y, tangents.square),
              least_area_of(balls_.radius, slack_, rate, farthest_corner()),
              rate,
              sphere.near_chord,
              sphere.far_chord,
              sphere.low(),
              sphere.high(),
              tangents.low_depth,
              tangents.high_depth};
  }

  // Of a place in the row that is about as near to the centre as any, how far it is from the surface, squared.
  HWY_INLINE V half_chord_square(Which which, V top, V bottom) const {
    const V centre = taken(balls_.depth, which), radius = taken(balls_.radius, which);
    const V depth = hn::Min(hn::Max(centre, all(near_.depth)), all(far_.depth)), along = hn::Sub(centre, depth);
    const V across =
        gap(hn::Mul(all(planes_->left), depth), taken(balls_.x, which), hn::Mul(all(planes_->right), depth));
    const V up = gap(hn::Mul(bottom, depth), taken(balls_.y, which), hn::Mul(top, depth));
    const V square = hn::Add(hn::Add(hn::Mul(across, across), hn::Mul(up, up)), hn::Mul(along, along));
    return hn::Sub(hn::Mul(radius, radius), square);
  }

  // How far away the spheres' tangents touch. `aside`: the square of the centre's distance from straight ahead.
  HWY_INLINE V tangent_from_eye(V aside) const {
    const V ahead = hn::Mul(hn::Sub(balls_.depth, balls_.radius), hn::Add(balls_.depth, balls_.radius));
    return root(hn::Add(ahead, aside));
  }

  // The sphere where it is level with its centre: chords in the slice's planes, and tangents in between.
  struct Sphere {
    Hull near_chord, far_chord;
    Tangents tangents;

    HWY_INLINE V low() const { return hn::IfThenElse(tangents.low_is_in, tangents.low, infinity()); }
    HWY_INLINE V high() const { return hn::IfThenElse(tangents.high_is_in, tangents.high, hn::Neg(infinity())); }
  };

  HWY_INLINE Sphere sphere_along(V across) const {
    const V tangent = tangent_from_eye(hn::Mul(across, across));
    Sphere sphere{empty_hull(), empty_hull(),
                  tangents_of(across, balls_.depth, balls_.radius, tangent, all(near_.depth), all(far_.depth))};
    add_chord(near_, across, balls_.near_square, near_half_, sphere.near_chord);
    add_chord(far_, across, balls_.far_square, far_half_, sphere.far_chord);
    return sphere;
  }

  HWY_INLINE V chord_square(const SlicePlane& plane) const {
    const V gap = hn::Sub(all(plane.depth), balls_.depth);
    return hn::Mul(hn::Sub(balls_.radius, gap), hn::Add(balls_.radius, gap));
  }

  // At least the squared distance to the farthest corner of the slice's part of the view. Balls smaller than half its
  // width do not hold it anyway.
  HWY_INLINE V farthest_corner() const {
    const float half_width = 0.49f * far_.depth * (planes_->right - planes_->left);
    if (hn::AllTrue(D(), hn::Lt(balls_.radius, all(half_width)))) return infinity();
    return hn::Max(farthest_corner(near_), farthest_corner(far_));
  }

  // The squared distance to the picture's farthest corner in a slice's plane.
  HWY_INLINE V farthest_corner(const SlicePlane& plane) const {
    const auto bottom = planes_->slope[static_cast<std::size_t>(planes_->rows)], top = planes_->slope.front();
    const V across = farther_end(balls_.x, planes_->left * plane.depth, planes_->right * plane.depth);
    const V up = farther_end(balls_.y, bottom * plane.depth, top * plane.depth);
    const V along = hn::Sub(balls_.depth, all(plane.depth));
    return hn::Add(hn::Add(hn::Mul(across, across), hn::Mul(up, up)), hn::Mul(along, along));
  }

  // Adds the slopes of the ends of a chord in a slice's plane. `square`: of the half, negative where there is none.
  HWY_INLINE static void add_chord(const SlicePlane& plane, V middle, V square, V half, Hull& hull) {
    const V inverse = all(plane.inverse);
    hull.add(hn::Ge(square, hn::Zero(D())), hn::Mul(hn::Sub(middle, half), inverse),
             hn::Mul(hn::Add(middle, half), inverse));
  }

  const RowPlanes* planes_ = nullptr;
  PlaneBalls balls_;
  LevelBalls level_;
  V slack_;
  V near_half_, far_half_;  // half chords
  VU lights_;
  SlicePlane near_, far_;
};

std::uint32_t lanes() {
  return static_cast<std::uint32_t>(hn::Lanes(D()));
}

// The rows of a batch, ball by ball from the top, one per lane: row t belongs to the ball in lane lane_of(t). The rows
// of a ball that touches the top of the picture begin with one above it.
class RowsOfBatch {
 public:
  RowsOfBatch() = default;
  HWY_INLINE RowsOfBatch(const BallRows& rows, RowScratch& scratch) : scratch_(&scratch) {
    const DI di;
    const auto n = static_cast<std::int32_t>(hn::Lanes(di));
    const VI listed = hn::AndNot(rows.held, hn::Add(rows.count, rows.planes_above)), end = sums(listed);
    begin_ = hn::Sub(end, listed);
    shift_ = hn::Sub(hn::Sub(rows.first, rows.planes_above), begin_);
    planes_end_ = hn::Sub(hn::Add(end, rows.planes_below), all_int(1));
    std::int32_t ends[k_most_lanes];
    hn::StoreU(end, di, ends);
    // What is written beyond a lane's end, the next one overwrites.
    const bool are_short = hn::AllTrue(di, hn::Lt(listed, all_int(n + 1)));
    for (std::int32_t lane = 0; lane < n; ++lane) {
      hn::StoreU(all_int(lane), di, scratch.lane.data() + count_);
      if (!are_short)
        for (count_ += n; count_ < ends[lane]; count_ += n) hn::StoreU(all_int(lane), di, scratch.lane.data() + count_);
      count_ = ends[lane];
    }
    hn::StoreU(hn::Zero(di), di, scratch.lane.data() + count_);
  }

  std::int32_t count() const { return count_; }
  HWY_INLINE VI lane_of(std::int32_t t) const { return hn::LoadU(DI(), scratch_->lane.data() + t); }
  // Its number, -1 above the picture.
  HWY_INLINE VI number_of(Which which, VI t) const { return hn::Add(taken(shift_, which), t); }
  // Is it its ball's first one?
  HWY_INLINE MI is_first(Which which, VI t) const { return hn::Eq(taken(begin_, which), t); }
  // Is there such a row, and can its ball touch the tile plane below it?
  HWY_INLINE MI has_plane(Which which, VI t) const {
    return hn::And(hn::Lt(t, taken(planes_end_, which)), hn::Lt(t, all_int(count_)));
  }

 private:
  RowScratch* scratch_ = nullptr;
  std::int32_t count_ = 0;
  VI begin_, shift_, planes_end_;  // of each ball: where its rows are listed; what is to be added for their numbers
};

// What balls have in the tile planes below the listed rows, as far as they can touch them, one after the other.
HWY_INLINE void store_planes(const PlaneTables& tables, const Batch& batch, const RowsOfBatch& rows,
                             RowScratch& scratch) {
  const D d;
  const DI di;
  const auto n = static_cast<std::int32_t>(hn::Lanes(d));
  std::int32_t count = 0;
  for (std::int32_t begin = 0; begin < rows.count(); begin += n) {
    const VI t = from_on(begin), lane = rows.lane_of(begin);
    const Which which = hn::IndicesFromVec(di, lane);
    const MI wanted = rows.has_plane(which, t);
    const VI plane = hn::Add(rows.number_of(which, t), all_int(1));
    hn::StoreU(compressed(di, plane, wanted), di, scratch.plane.data() + count);
    hn::StoreU(compressed(di, lane, wanted), di, scratch.plane_lane.data() + count);
    count += static_cast<std::int32_t>(hn::CountTrue(di, wanted));
  }
  for (std::int32_t begin = 0; begin < count; begin += n) {
    const MI exists = hn::Lt(from_on(begin), all_int(count));
    const VI lane = hn::IfThenElseZero(exists, hn::LoadU(di, scratch.plane_lane.data() + begin));
    const VI plane = hn::IfThenElseZero(exists, hn::LoadU(di, scratch.plane.data() + begin));
    const Hull hull = batch.plane_hull(hn::IndicesFromVec(di, lane), tables, plane);
    hn::StoreU(hull.low, d, scratch.low.data() + begin);
    hn::StoreU(hull.high, d, scratch.high.data() + begin);
  }
}

// The hulls in the tile planes above and below the listed rows, vector by vector.
class PlanesOfRows {
 public:
  HWY_INLINE explicit PlanesOfRows(const RowScratch& scratch) : low_(scratch.low.data()), high_(scratch.high.data()) {}

  // What the next rows have in both planes; above only those that are not their ball's first.
  HWY_INLINE Hull next(M has_below, M has_above) {
    const D d;
    Hull hull = {expanded(d, hn::LoadU(d, low_), has_below, infinity()),
                 expanded(d, hn::LoadU(d, high_), has_below, hn::Neg(infinity()))};
    const std::size_t count = hn::CountTrue(d, has_below);
    low_ += count;
    high_ += count;
    hull.add(has_above, carry_(hull.low, turned_.low), carry_(hull.high, turned_.high));
    return hull;
  }

 private:
  const float *low_, *high_;
  Carried carry_;
  Hull turned_ = empty_hull();  // of the planes below the rows before
};

// The columns of all rows, from what was stored of their planes.
HWY_INLINE void find_columns(const PlaneTables& tables, const Batch& batch, const RowsOfBatch& rows, int grid_rows,
                             const RowScratch& scratch, BatchRows& out) {
  const D d;
  const DI di;
  const auto n = static_cast<std::int32_t>(hn::Lanes(d));
  const VI nowhere = all_int(grid_rows * n), zero = hn::Zero(di), last_row = all_int(grid_rows - 1);
  PlanesOfRows planes(scratch);
  for (std::int32_t begin = 0; begin < rows.count(); begin += n) {
    const VI t = from_on(begin), lane = rows.lane_of(begin);
    const Which which = hn::IndicesFromVec(di, lane);
    const VI row = rows.number_of(which, t);
    const MI wanted = hn::And(hn::Gt(row, all_int(-1)), hn::Lt(t, all_int(rows.count())));
    // The plane above is that below the row before, if both are the same ball's.
    Hull hull =
        planes.next(hn::RebindMask(d, rows.has_plane(which, t)), hn::RebindMask(d, hn::Not(rows.is_first(which, t))));
    const VI above = hn::Min(hn::Max(row, zero), last_row), below = hn::Add(above, all_int(1));
    const V top = tables.slope.at(above), bottom = tables.slope.at(below);
    batch.add_level(which, top, bottom, hull);
    const VU columns = batch.columns_of(which, top, bottom, hull, hn::RebindMask(d, wanted));
    const VI to = hn::Add(hn::Mul(row, all_int(n)), lane);
    hn::ScatterIndex(hn::BitCast(di, columns), di, reinterpret_cast<std::int32_t*>(out.columns.data()),
                     hn::IfThenElse(wanted, to, nowhere));
  }
}

// Step by step for all batches, because the steps of one wait for each other.
void rows_of_batches(const RowPlanes& planes, const SeenBalls& seen, std::span<const BallsOfSlice> balls,
                     RowBatches& out) {
  const std::size_t count = balls.size();
  const PlaneTables tables(planes);
  Batch batches[k_batches_at_once];
  BallRows ball_rows[k_batches_at_once];
  RowsOfBatch rows[k_batches_at_once];
  for (std::size_t i = 0; i < count; ++i) {
    batches[i] = Batch(planes, seen, balls[i]);
    ball_rows[i] = batches[i].find_rows(hn::FirstN(D(), balls[i].count));
  }
  for (std::size_t i = 0; i < count; ++i) {
    start_batch(planes.rows, ball_rows[i].first, ball_rows[i].count, batches[i].lights(),
                batches[i].columns_of_held(ball_rows[i].held), out.batches[i]);
    rows[i] = RowsOfBatch(ball_rows[i], out.scratch[i]);
  }
  for (std::size_t i = 0; i < count; ++i) store_planes(tables, batches[i], rows[i], out.scratch[i]);
  for (std::size_t i = 0; i < count; ++i)
    find_columns(tables, batches[i], rows[i], planes.rows, out.scratch[i], out.batches[i]);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(lanes);
HWY_EXPORT(rows_of_batches);

void BatchRows::make_room(int of_rows) {
  const std::size_t size = (static_cast<std::size_t>(of_rows) + 1) * k_row_lanes;
  if (columns.size() < size) columns.resize(size);
}

void RowScratch::make_room(int of_rows) {
  const std::size_t size = entries(of_rows);
  for (AlignedVector<std::int32_t>* list : {&lane, &plane, &plane_lane}) list->resize(size);
  for (AlignedVector<float>* list : {&low, &high}) list->resize(size);
}

void RowBatches::make_room(int of_rows) {
  if (scratch.back().has_room(of_rows)) return;
  for (BatchRows& batch : batches) batch.make_room(of_rows);
  for (RowScratch& rows : scratch) rows.make_room(of_rows);
}

std::size_t RowBatches::capacity_bytes() const {
  std::size_t bytes = 0;
  for (const BatchRows& batch : batches) bytes += batch.capacity_bytes();
  for (const RowScratch& rows : scratch) bytes += rows.capacity_bytes();
  return bytes;
}

std::uint32_t balls_per_batch() {
  return HWY_DYNAMIC_DISPATCH(lanes)();
}

void find_rows(const RowPlanes& planes, const SeenBalls& seen, std::span<const BallsOfSlice> balls, RowBatches& out) {
  out.make_room(planes.rows);  // of all batches, however many a machine needs
  if (planes.orthographic) return find_flat_rows(planes, seen, balls, out);
  HWY_DYNAMIC_DISPATCH(rows_of_batches)(planes, seen, balls, out);
}

}  // namespace clusterbench::assign
#endif
