#include "assign/rows/slice_rows.h"

#include <algorithm>
#include <cmath>

#include "assign/rows/orthographic_rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assign/rows/slice_rows.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target
#include <hwy/highway.h>

#include "assign/rows/batch_rows-inl.h"
#include "assign/rows/plane_tables-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {
namespace {

// Slopes x / depth from low to high.
struct Hull {
  V low, high;
};

// One of the slice's two planes. The inverse depth of a plane at the eye ends where its products with reaches would not
// be finite; for what that changes see RowPlanes::least_reach.
struct SlicePlane {
  float depth, inverse;

  SlicePlane() = default;
  SlicePlane(const RowPlanes& planes, std::size_t k)
      : depth(planes.depth[k]), inverse(std::min(planes.inverse_depth[k], RowPlanes::k_most_inverse_depth)) {}
};

// Balls of a slice, one per lane.
struct Spheres {
  V x, y, depth, radius;

  HWY_INLINE Spheres of(Which which) const {
    return {taken(x, which), taken(y, which), taken(depth, which), taken(radius, which)};
  }
  // At an inverse depth a ball is a disk around (x, y) times that; half of what it has of a line that is `offset` from
  // its centre.
  HWY_INLINE V half_chord(V inverse, V offset) const {
    const V before = (radius + depth) * inverse - all(1.0f);
    const V behind = all(1.0f) - (depth - radius) * inverse;
    return root(before * behind - offset * offset);
  }
};

// The rows that balls may touch.
struct BallRows {
  VI first, count;
  VI full;  // all bits of those that hold all of the slice's part of the view: all columns of all rows are theirs

  HWY_INLINE MI are_full() const { return Ne(full, Zero(DI())); }
  // Those of the others that may touch a row.
  HWY_INLINE MI others_in(int row) const {
    const VI end = first + AndNot(full, count);
    const MI has_begun = first < all_int(row + 1);
    return And(has_begun, end > all_int(row));
  }
};

// Rows of one batch.
class Batch {
 public:
  HWY_INLINE void start(const RowPlanes& planes, const SphereSetup& shapes, const BallsOfSlice& balls) {
    planes_ = &planes;
    near_ = {planes, static_cast<std::size_t>(balls.slice)};
    far_ = {planes, static_cast<std::size_t>(balls.slice) + 1};
    const Quads sphere = gathered_quads(shapes.sphere.data(), balls.indices);
    balls_ = {sphere.first, sphere.second, sphere.third, sphere.fourth};
    const Quads touch = gathered_quads(shapes.touch.data(), balls.indices);
    slack_ = touch.first;
    lights_ = BitCast(DU(), touch.second);
    lean_ = touch.third;
    inverse_upright_ = touch.fourth;
    const M is_ball = FirstN(D(), balls.count);
    is_precise_ = AllFalse(D(), And(is_ball, inverse_upright_ == Zero(D())));
    const Quads extremes = gathered_quads(shapes.extremes.data(), balls.indices);
    find_extremes({within(extremes.first), within(extremes.second)}, {within(extremes.third), within(extremes.fourth)});
    const V nearest = Max(all(near_.depth), balls_.depth - (balls_.radius + slack_));
    rate_ = all(planes.columns_per_slope) / nearest;
    least_area_ = least_area_of(balls_.radius, slack_, rate_, farthest_corner());
  }

  VU lights() const { return lights_; }

  // The rows that each ball may touch. `wanted`: the lanes that hold a ball.
  HWY_INLINE BallRows find_rows(M wanted) const {
    const V top = all(planes_->slope.front()), bottom = all(planes_->slope[static_cast<std::size_t>(planes_->rows)]);
    const M is_level = And(upwards_.low <= top, upwards_.high >= bottom);
    const M is_between_sides = And(sideways_.low <= all(planes_->right), sideways_.high >= all(planes_->left));
    const M touches = And(wanted, And(is_level, is_between_sides));
    const V scale = all(planes_->rows_per_slope), tolerance = all(planes_->row_tolerance), zero = Zero(D());
    const V from = (top - Min(upwards_.high, top)) * scale - tolerance;
    const V to = (top - Max(upwards_.low, bottom)) * scale + tolerance;
    const VI last_row = all_int(planes_->rows - 1);
    const VI full = VecFromMask(DI(), RebindMask(DI(), And(wanted, holds_view())));
    const VI first = Min(whole(Floor(Max(from, zero))), last_row);
    const VI last = Min(whole(Floor(Max(to, zero))), last_row);
    const VI count = IfThenElseZero(RebindMask(DI(), touches), last - first + all_int(1));
    return {AndNot(full, first), Or(AndNot(full, count), And(full, all_int(planes_->rows))), full};
  }

  VU all_columns() const { return Set(DU(), ColumnSpan::of(0, static_cast<std::uint32_t>(planes_->columns) - 1)); }

  // What the balls in which[i] have between two tile planes. At each depth a ball is a disk, so it reaches farthest
  // to the side at its centre's height, or in the tile plane that is nearer to that; within a tile plane it does so
  // where the tangent touches, or in the slice's plane that is nearer to that.
  HWY_INLINE Hull hull_of(Which which, V top, V bottom) const {
    const RowBalls balls = {balls_.of(which), taken(lean_, which), taken(inverse_upright_, which)};
    const auto in_row = [&](V slope) { return Min(Max(taken(slope, which), bottom), top); };
    return {end_of<-1>(balls, in_row(farthest_left_)), end_of<1>(balls, in_row(farthest_right_))};
  }

  // The columns of that.
  //
  // Certainty. Let r be the given radius, d the slack, R = r + d, and e = 2^-24 of the reach, so that d >= 28 e. An end
  // is x / depth of a point of the larger ball: its depth and its plane through the eye are chosen within the slice and
  // the row, and what follows from them is less than 8 e off; so the ball of r + 2 d has such a point. And it is no
  // further in than the given ball's. For where the end is looked for is rounded, too, by s along the circle of radius
  // w that a tile plane cuts out; near the circle's farthest point that loses s² / 2 w, while the given ball's circle
  // is smaller by at least d R / w. So s = sqrt(7 e R) costs an eighth of that. Depths and heights make it up to 3 e;
  // the circle's chord, which is up to 2 e R / w off, and inverse_upright as much as set_up_spheres() lets them, 1.6
  // times sqrt(7 e R) together: a third. It also makes certain whether the eye is inside the ball or a circle, where
  // all depends on a sign.
  //
  // So the hull is that of a ball between the given one and the given one with twice the slack, D = 2 d. Let m be the
  // row's point nearest to the centre, g away, and w = sqrt(R² - g²) for the larger radius R. A point p of the larger
  // ball in the row is within w of m; moved towards m by the share D / (R - g) of that it is in the given ball, and
  // still in the row (here its part in the picture). That is D w / (R - g) = D (R + g) / w <= 2 D R / w far. From a
  // point of slope s on, a metre is at most q = sqrt(1 + s²) / near of slope, where no point of the larger ball in the
  // slice is nearer in depth than `near`, so the given ball's extremes are within 2 D R q / w of the hull's, and
  // the hull's width in the picture, h, is at most 2 w q; so that is at most 4 D R q² / h. The
  // columns are certainly right if the hull's ends are farther than that from the next boundary inwards: that is, if
  // the distance times h is at least 4 D R q² = 8 slack R q², in columns the `least_area`. And the given ball reaches
  // the row at all if R - g >= D, which follows from h² >= 8 D R q². Large balls near the eye are far wider than the
  // picture, and h says little of w. For them any point in the row does instead of m: it is no nearer, so its w is no
  // larger. The columns are certain if the way inwards is at least 2 D R q / w, and the ball reaches the row if w² >= 2
  // D R.
  HWY_INLINE VU columns_of(Which which, const PlaneTable& slopes, VI row, const Hull& hull, M wanted) const {
    return columns_between(
        *planes_, hull.low, hull.high, wanted, taken(least_area_, which),
        [](V least, V most) { return all(1.0f) + Max(least * least, most * most); },
        [&](V inwards, V steepness) {
          const V radius = taken(balls_.radius, which), slack = taken(slack_, which);
          const V top = slopes.at(row), bottom = slopes.at(row + all_int(1));
          return is_certain_by_chord(half_chord_square(which, top, bottom), inwards, radius, slack, taken(rate_, which),
                                     steepness);
        });
  }

 private:
  // What rows want of their balls.
  struct RowBalls {
    Spheres spheres;
    V lean, inverse_upright;
  };

  // The nearest inverse depth in the slice.
  HWY_INLINE V within(V inverse) const { return Min(Max(inverse, all(far_.inverse)), all(near_.inverse)); }

  // `sideways`, `upwards`: the inverse depths where the balls reach farthest within the slice.
  HWY_INLINE void find_extremes(const Hull& sideways, const Hull& upwards) {
    const auto radius_at = [&](V inverse) { return balls_.half_chord(inverse, Zero(D())); };
    upwards_ = {balls_.y * upwards.low - radius_at(upwards.low), balls_.y * upwards.high + radius_at(upwards.high)};
    sideways_ = {(balls_.x - balls_.radius) * sideways.low, (balls_.x + balls_.radius) * sideways.high};
    farthest_left_ = balls_.y * sideways.low;
    farthest_right_ = balls_.y * sideways.high;
  }

  // The least (side = -1) or greatest (side = 1) slope x / depth in tile planes of some slopes.
  template <int side>
  HWY_INLINE V end_of(const RowBalls& balls, V slope) const {
    const auto go = [](V from, V by) { return side < 0 ? from - by : from + by; };
    const Spheres& ball = balls.spheres;
    const V away = ball.y - slope * ball.depth;
    const V tilt_square = all(1.0f) + slope * slope;
    const V chord = root(ball.radius * ball.radius * tilt_square - away * away);
    const V ahead = ball.depth + slope * ball.y;
    V touch = go(ahead, balls.lean * chord) * balls.inverse_upright;
    if (!is_precise_) touch = precise_touch<side>(balls, chord, ahead, tilt_square, touch);
    // Where none touches ahead of the eye the ball grows towards it.
    const M is_ahead = touch > Zero(D());
    const V inverse = IfThenElse(is_ahead, within(touch), all(near_.inverse));
    const V offset = slope - ball.y * inverse;
    return go(ball.x * inverse, ball.half_chord(inverse, offset));
  }

  // Where the tangent touches, for balls of which inverse_upright does not say so precisely enough.
  template <int side>
  HWY_NOINLINE V precise_touch(const RowBalls& balls, V chord, V ahead, V tilt_square, V otherwise) const {
    const Spheres& ball = balls.spheres;
    const V zero = Zero(D()), at_eye = all(SphereSetup::k_at_eye);
    const V ahead_square = (ball.depth - ball.radius) * (ball.depth + ball.radius);
    const V upright = ball.y * ball.y + ahead_square, x_square = ball.x * ball.x;
    const V sum = ahead + Abs(balls.lean) * chord;
    const V square = x_square + upright;
    const V from_eye = ahead * ahead + x_square * tilt_square;
    const V outer = IfThenElse(upright > zero, sum / upright, at_eye);
    const V inner = IfThenElse(sum > zero, from_eye / (square * sum), at_eye);
    const M is_outer = side < 0 ? ball.x < zero : ball.x >= zero;
    const V precise = IfThenElse(is_outer, outer, inner);
    return IfThenElse(balls.inverse_upright == zero, precise, otherwise);
  }

  HWY_INLINE M holds_view() const { return least_area_ == Zero(D()); }

  // Of a point in the row that is about as near to the centre as any, how far it is from the surface, squared.
  HWY_INLINE V half_chord_square(Which which, V top, V bottom) const {
    const V centre = taken(balls_.depth, which), radius = taken(balls_.radius, which);
    const V depth = Min(Max(centre, all(near_.depth)), all(far_.depth)), along = centre - depth;
    const V across = gap(all(planes_->left) * depth, taken(balls_.x, which), all(planes_->right) * depth);
    const V up = gap(bottom * depth, taken(balls_.y, which), top * depth);
    const V square = across * across + up * up + along * along;
    return radius * radius - square;
  }

  // At least the squared distance to the farthest corner of the slice's part of the view. Balls smaller than half its
  // width do not hold it anyway.
  HWY_INLINE V farthest_corner() const {
    const float half_width = 0.49f * far_.depth * (planes_->right - planes_->left);
    if (AllTrue(D(), balls_.radius < all(half_width))) return infinity();
    return Max(farthest_corner(near_), farthest_corner(far_));
  }

  // The squared distance to the picture's farthest corner in a slice's plane.
  HWY_INLINE V farthest_corner(const SlicePlane& plane) const {
    const auto bottom = planes_->slope[static_cast<std::size_t>(planes_->rows)], top = planes_->slope.front();
    const V across = farther_end(balls_.x, planes_->left * plane.depth, planes_->right * plane.depth);
    const V up = farther_end(balls_.y, bottom * plane.depth, top * plane.depth);
    const V along = balls_.depth - all(plane.depth);
    return across * across + up * up + along * along;
  }

  const RowPlanes* planes_;
  SlicePlane near_, far_;
  Spheres balls_;
  V slack_;
  VU lights_;
  V lean_, inverse_upright_;          // SphereSetup::touch
  bool is_precise_;                   // that is, everywhere
  Hull upwards_;                      // of what balls have in the slice, y / depth
  Hull sideways_;                     // at least that, x / depth
  V farthest_left_, farthest_right_;  // where that is farthest to a side, y / depth
  V rate_;                            // the most columns that a metre to the side can be
  V least_area_;                      // for rows straight ahead
};

std::uint32_t lanes() {
  return static_cast<std::uint32_t>(Lanes(D()));
}

// Which row and ball a span is of, in one number.
struct Place {
  static constexpr int k_lane_bits = 6;
  static_assert(k_most_lanes <= 1 << k_lane_bits);

  VI row;
  Which ball;

  HWY_INLINE explicit Place(VI place)
      : row(hn::ShiftRight<k_lane_bits>(place)),
        ball(IndicesFromVec(DI(), And(place, all_int((1 << k_lane_bits) - 1)))) {}
  // Of all balls in a row.
  static HWY_INLINE VI all_of(int row) { return from_on(row << k_lane_bits); }
};

// The balls that may touch each row, and do not hold all of it, row after row.
HWY_INLINE void list_places(const BallRows& rows, std::int32_t* HWY_RESTRICT places, BatchSpans& out) {
  const DI di;
  std::uint32_t* HWY_RESTRICT sizes = out.sizes.data();
  std::uint32_t count = 0;
  const VU others = BitCast(DU(), AndNot(rows.full, rows.count));
  VU skipped = BitCast(DU(), all_int(out.first_row) - rows.first);  // of each ball's rows; large before its first one
  VI place = Place::all_of(out.first_row);
  for (int row = out.first_row, last = out.last_row; row <= last; ++row) {
    const MI wanted = RebindMask(di, skipped < others);
    StoreU(compressed(di, place, wanted), di, places + count);
    const auto size = static_cast<std::uint32_t>(CountTrue(di, wanted));
    sizes[row] = size;
    count += size;
    skipped = skipped + Set(DU(), 1);
    place = place + all_int(1 << Place::k_lane_bits);
  }
  StoreU(Zero(di), di, places + count);
  out.count = count;
}

// What the balls have in all rows, as slopes.
HWY_INLINE void find_hulls(const PlaneTable& slopes, const Batch& batch, const std::int32_t* places,
                           std::uint32_t count, RowHulls& out) {
  const D d;
  for (std::uint32_t begin = 0; begin < count; begin += static_cast<std::uint32_t>(Lanes(d))) {
    const Place place(LoadU(DI(), places + begin));
    const Hull hull = batch.hull_of(place.ball, slopes.at(place.row), slopes.at(place.row + all_int(1)));
    StoreU(hull.low, d, out.low.data() + begin);
    StoreU(hull.high, d, out.high.data() + begin);
  }
}

// The columns of all rows.
HWY_INLINE void find_columns(const PlaneTable& slopes, const Batch& batch, const std::int32_t* places,
                             const RowHulls& hulls, BatchSpans& out) {
  const D d;
  const DU du;
  for (std::uint32_t begin = 0; begin < out.count; begin += static_cast<std::uint32_t>(Lanes(d))) {
    const Place place(LoadU(DI(), places + begin));
    const Hull hull = {LoadU(d, hulls.low.data() + begin), LoadU(d, hulls.high.data() + begin)};
    const VU columns = batch.columns_of(place.ball, slopes, place.row, hull, FirstN(d, out.count - begin));
    StoreU(columns, du, out.columns.data() + begin);
    StoreU(BitCast(du, taken(BitCast(DI(), batch.lights()), place.ball)), du, out.lights.data() + begin);
    list_uncertain(columns, out.count - begin, begin, out);
  }
}

// Adds to each row those that hold all of it.
HWY_INLINE void add_full(const Batch& batch, const BallRows& rows, AlignedVector<std::uint32_t>& some_columns,
                         BatchSpans& out) {
  const DU du;
  const MI full = rows.are_full();
  std::swap(some_columns, out.columns);
  std::uint32_t from = 0;
  out.count = out.uncertain_count = 0;
  for (int row = out.first_row; row <= out.last_row; ++row) {
    std::uint32_t& size = out.sizes[static_cast<std::size_t>(row)];
    const MI found = rows.others_in(row);
    const auto wanted = RebindMask(du, Or(found, full));
    const VU columns = IfThenElse(RebindMask(du, full), batch.all_columns(),
                                  expanded(du, LoadU(du, some_columns.data() + from), RebindMask(du, found)));
    const VU listed = compressed(du, columns, wanted);
    StoreU(listed, du, out.columns.data() + out.count);
    StoreU(compressed(du, batch.lights(), wanted), du, out.lights.data() + out.count);
    from += size;
    size = static_cast<std::uint32_t>(CountTrue(du, wanted));
    list_uncertain(listed, size, out.count, out);
    out.count += size;
  }
}

// Step by step for all batches, because the steps of one wait for each other.
void rows_of_batches(const RowPlanes& planes, const SphereSetup& shapes, std::span<const BallsOfSlice> balls,
                     RowBatches& out) {
  const std::size_t count = balls.size();
  const PlaneTable slopes(planes.slope, planes.rows + 1);
  Batch batches[k_batches_at_once];
  BallRows ball_rows[k_batches_at_once];
  for (std::size_t i = 0; i < count; ++i) {
    batches[i].start(planes, shapes, balls[i]);
    ball_rows[i] = batches[i].find_rows(FirstN(D(), balls[i].count));
  }
  for (std::size_t i = 0; i < count; ++i) {
    start_batch(planes.rows, ball_rows[i].first, ball_rows[i].count, out.batches[i]);
    list_places(ball_rows[i], out.places[i].data(), out.batches[i]);
  }
  for (std::size_t i = 0; i < count; ++i)
    find_hulls(slopes, batches[i], out.places[i].data(), out.batches[i].count, out.hulls[i]);
  for (std::size_t i = 0; i < count; ++i) {
    find_columns(slopes, batches[i], out.places[i].data(), out.hulls[i], out.batches[i]);
    if (!AllFalse(DI(), ball_rows[i].are_full())) add_full(batches[i], ball_rows[i], out.some_columns, out.batches[i]);
  }
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

// A vector more than a batch can have, as whole vectors are written and read from each span on; and one behind them.
void BatchSpans::make_room(int of_rows) {
  sizes.resize(static_cast<std::size_t>(of_rows));
  const std::size_t size = (static_cast<std::size_t>(of_rows) + 2) * k_row_lanes;
  for (AlignedVector<std::uint32_t>* list : {&lights, &columns, &uncertain}) list->resize(size);
}

void RowBatches::make_room(int of_rows) {
  const std::size_t size = (static_cast<std::size_t>(of_rows) + 2) * k_row_lanes;
  if (some_columns.size() >= size) return;
  some_columns.resize(size);
  for (BatchSpans& batch : batches) batch.make_room(of_rows);
  for (AlignedVector<std::int32_t>& list : places) list.resize(size);
  for (RowHulls& list : hulls) list.make_room(size);
}

std::size_t RowBatches::capacity_bytes() const {
  std::size_t bytes = bytes_of(some_columns);
  for (const BatchSpans& batch : batches) bytes += batch.capacity_bytes();
  for (const AlignedVector<std::int32_t>& list : places) bytes += bytes_of(list);
  for (const RowHulls& list : hulls) bytes += list.capacity_bytes();
  return bytes;
}

std::uint32_t balls_per_batch() {
  return HWY_DYNAMIC_DISPATCH(lanes)();
}

void find_rows(const RowPlanes& planes, const VisibleBalls& visible, const SphereSetup& shapes,
               std::span<const BallsOfSlice> balls, RowBatches& out) {
  out.make_room(planes.rows);  // of all batches, however many a machine needs
  if (planes.orthographic) return find_orthographic_rows(planes, visible, balls, out);
  HWY_DYNAMIC_DISPATCH(rows_of_batches)(planes, shapes, balls, out);
}

}  // namespace clusterbench::assign
#endif
