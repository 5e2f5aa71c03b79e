#include "assign/rows/slice_rows.h"

#include <algorithm>
#include <limits>

#define HWY_TARGET_INCLUDE "assign/rows/slice_rows.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target

#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign::HWY_NAMESPACE {
namespace {

// From low to high: slopes x / depth or y / depth, in orthographic grids x or y.
struct Hull {
  V low, high;
};

// Balls, one per lane.
struct Balls {
  V x, y, depth, radius, slack;
  V lean, inverse_upright;  // see set_up_spheres()

  HWY_INLINE Balls of(Which which) const {
    return {taken(x, which),     taken(y, which),    taken(depth, which),          taken(radius, which),
            taken(slack, which), taken(lean, which), taken(inverse_upright, which)};
  }
  // At an inverse depth a ball is a disk around (x, y) times that inverse depth. Half of the disk's chord on a line at
  // distance `offset` from its centre.
  HWY_INLINE V half_chord(V inverse, V offset) const {
    const V before = (radius + depth) * inverse - all(1.0f);
    const V behind = all(1.0f) - (depth - radius) * inverse;
    return root(before * behind - offset * offset);
  }
};

// The distance of a coordinate from the farther end of an interval.
HWY_INLINE V farther_end(V low, V coordinate, V high) {
  return Max(Abs(coordinate - low), Abs(coordinate - high));
}

// The rows that balls may touch.
struct BallRows {
  VI first, count;
  MI full;  // balls that contain the slice's whole part of the view: they touch all columns of all rows
};

// The row and the ball of a span, in one number.
struct RowBall {
  static constexpr int k_lane_bits = 6;
  static_assert(k_most_lanes <= 1 << k_lane_bits);

  VI row;
  Which ball;

  HWY_INLINE explicit RowBall(VU number)
      : row(BitCast(DI(), hn::ShiftRight<k_lane_bits>(number))),
        ball(IndicesFromVec(DI(), BitCast(DI(), And(number, all((1u << k_lane_bits) - 1))))) {}
  // All balls in a row.
  static HWY_INLINE VU all_of(int row) { return BitCast(DU(), from_on(row << k_lane_bits)); }
};

// The balls of a batch, one per lane, in its slice.
template <bool orthographic>
class Batch {
 public:
  HWY_INLINE void start(const RowPlanes& planes, const SphereSetup& shapes, const BallsOfSlice& balls) {
    planes_ = &planes;
    const auto slice = static_cast<std::size_t>(balls.slice);
    near_ = planes.depth[slice];
    far_ = planes.depth[slice + 1];
    nearest_inverse_ = inverse_depth(planes, slice);
    farthest_inverse_ = inverse_depth(planes, slice + 1);
    const Quads sphere = gathered_quads(shapes.sphere.data(), balls.indices);
    const Quads touch = gathered_quads(shapes.touch.data(), balls.indices);
    balls_ = {sphere.first, sphere.second, sphere.third, sphere.fourth, touch.first, touch.third, touch.fourth};
    lights_ = BitCast(DU(), touch.second);
    are_balls_ = FirstN(D(), balls.count);
    if constexpr (orthographic)
      find_extremes_of_disks();
    else
      find_extremes(gathered_quads(shapes.extremes.data(), balls.indices));
    const V nearest = Max(all(near_), balls_.depth - (balls_.radius + balls_.slack));
    rate_ = all(planes.columns_per_slope) / metres_per_slope(nearest);
    least_area_ = least_area();
  }

  VU lights() const { return lights_; }
  VU all_columns() const { return all(ColumnSpan::of(0, static_cast<std::uint32_t>(planes_->columns) - 1)); }

  HWY_INLINE BallRows find_rows() const {
    const V top = all(planes_->slope.front()), bottom = all(planes_->slope[static_cast<std::size_t>(planes_->rows)]);
    const M is_level = And(upwards_.low <= top, upwards_.high >= bottom);
    const M is_between_sides = And(sideways_.low <= all(planes_->right), sideways_.high >= all(planes_->left));
    const M touches = And(are_balls_, And(is_level, is_between_sides));
    const V scale = all(planes_->rows_per_slope), tolerance = all(planes_->row_tolerance), zero = Zero(D());
    const V from = (top - Min(upwards_.high, top)) * scale - tolerance;
    const V to = (top - Max(upwards_.low, bottom)) * scale + tolerance;
    const VI last_row = all(planes_->rows - 1);
    const VI first = Min(whole(Floor(Max(from, zero))), last_row);
    const VI last = Min(whole(Floor(Max(to, zero))), last_row);
    const VI count = IfThenElseZero(RebindMask(DI(), touches), last - first + all(1));
    return {first, count, RebindMask(DI(), And(touches, least_area_ == zero))};
  }

  // The extents of the balls in which[i] between two tile planes. At each depth a ball is a disk, so it extends
  // farthest to the side at its centre's height, or in the tile plane that is nearer to that; within a tile plane it
  // does so where the tangent touches, or in the slice's plane that is nearer to that.
  HWY_INLINE Hull hull_of(Which which, V top, V bottom) const {
    const Balls balls = balls_.of(which);
    if constexpr (orthographic) {
      const V away = gap(bottom, balls.y, top);
      const V half = root(taken(disk_square_, which) - away * away);
      return {balls.x - half, balls.x + half};
    } else {
      const auto in_row = [&](V slope) { return Min(Max(taken(slope, which), bottom), top); };
      return {end_of<-1>(balls, in_row(farthest_left_)), end_of<1>(balls, in_row(farthest_right_))};
    }
  }

  // The columns of that hull, and the marks of its uncertain ends.
  //
  // Certainty. Let r be the given radius, d the slack, R = r + d, and e = 2^-24 of the reach, so that d >= 28 e. An end
  // is x / depth of a point of the larger ball: its depth and its plane through the eye are chosen within the slice and
  // the row, and the values that follow from them are less than 8 e off; so the ball of r + 4/3 d has such a point. And
  // it is no further in than the given ball's. For the position of the end is rounded, too, by s along the circle of
  // radius w that a tile plane cuts out; near the circle's farthest point that loses s² / 2 w, while the given ball's
  // circle is smaller by at least d (2 R - d) / 2 w, and so by d R / 2 w. So s = sqrt(7 e R) costs at most a quarter of
  // that. Depths and heights make it up to 3 e; the circle's chord, which is up to 2 e R / w off, and inverse_upright
  // as much as set_up_spheres() lets them, 1.6 times sqrt(7 e R) together: two thirds. It also makes certain whether
  // the eye is inside the ball or a circle, where all depends on a sign.
  //
  // So the hull is that of a ball between the given one and one that is larger by D = 4/3 d, of radius P = r + D. Let m
  // be the row's point nearest to the centre, g away, and w = sqrt(P² - g²). A point p of the larger ball in the row is
  // within w of m; moved towards m by the share D / (P - g) of that it is in the given ball, and still in the row (here
  // its part in the picture). That is D w / (P - g) = D (P + g) / w <= 2 D P / w far. From a point of slope s on, a
  // metre is at most q = sqrt(1 + s²) / near of slope, where no point of the larger ball in the slice is nearer in
  // depth than `near`, so the given ball's extremes are within 2 D P q / w of the hull's, and the hull's width in the
  // picture, h, is at most 2 w q; so that is at most 4 D P q² / h. The columns are certainly right if the hull's ends
  // are farther than that from the next boundary inwards: if the distance times h is at least 8 d R q² > 4 D P q², in
  // columns the `least_area`. And the given ball reaches the row at all if P - g >= D, which follows from h² >= 8 D P
  // q², and that from h² >= 16 d R q². Large balls near the eye are far wider than the picture, and h says little of w.
  // For them any point in the row does instead of m: it is no nearer, so its w is no larger. The columns are certain if
  // the way inwards is at least 4 d R q / w > 2 D P q / w, and the ball reaches the row if w² >= 4 d R > 2 D P.
  //
  // For example, a ball of 2 m whose centre is 5 m to the right and 20 m ahead, in the row and the slice that contain
  // it: its reach is 27 m, e = 1.6e-6 m, d = 4.5e-5 m, the hull goes from 0.149 to 0.356, h = 0.207, q = 0.059 per
  // metre, and 8 d R q² / h = 1.2e-5. With 30 columns from -1 to 1 that is 1 / 5,500 of a column: of 5,500 ends one is
  // left to be decided.
  HWY_INLINE VU columns_of(const RowBall& at, const Table& slopes, const Hull& hull, M wanted) const {
    const V left = all(planes_->left), right = all(planes_->right), scale = all(planes_->columns_per_slope);
    const V tolerance = all(planes_->column_tolerance), zero = Zero(D());
    const M touches = And(wanted, And(hull.low <= Min(hull.high, right), hull.high >= left));
    const V low = Max(hull.low, left), high = Min(hull.high, right);
    const V from = (low - left) * scale, to = (high - left) * scale;
    const V last_column = all(static_cast<float>(planes_->columns - 1));
    const V first = Min(Floor(Max(from - tolerance, zero)), last_column);
    const V last = Min(Floor(to + tolerance), last_column);
    // The certain part of the width: in a wide picture, a small ball is narrower than the rounding of coordinates.
    const V width = Max(to - from - (tolerance + tolerance), zero);
    const V from_first = first + all(1.0f) - from - tolerance, to_last = to - last - tolerance;
    const V steepness = orthographic ? all(1.0f) : all(1.0f) + Max(low * low, high * high);
    const V area = taken(least_area_, at.ball) * steepness;
    const auto is_certain = [&](V inwards) { return And(inwards * width >= area, width * width >= area + area); };
    VU columns = BitCast(DU(), Or(whole(first), ShiftLeft<16>(whole(last))));
    if (!AllTrue(D(), Or(is_certain(Min(from_first, to_last)), Not(touches)))) {
      const auto mark = [&](V inwards, std::uint32_t bit) {
        const M certain = Or(is_certain(inwards), is_certain_by_chord(at, slopes, inwards, steepness));
        return IfThenZeroElse(RebindMask(DU(), certain), all(bit));
      };
      columns = Or(columns, Or(mark(from_first, BatchSpans::k_first_is_uncertain),
                               mark(to_last, BatchSpans::k_last_is_uncertain)));
    }
    return IfThenElse(RebindMask(DU(), touches), columns, all(BatchRows::k_none));
  }

 private:
  // The inverse depth of one of the slice's two planes. At the eye it is limited so that its products with reaches stay
  // finite; for the effect of this see RowPlanes::least_reach.
  static float inverse_depth(const RowPlanes& planes, std::size_t plane) {
    return std::min(planes.inverse_depth[plane], RowPlanes::k_most_inverse_depth);
  }

  static HWY_INLINE V metres_per_slope(V depth) { return orthographic ? all(1.0f) : depth; }

  // The nearest inverse depth in the slice.
  HWY_INLINE V within(V inverse) const { return Min(Max(inverse, all(farthest_inverse_)), all(nearest_inverse_)); }

  HWY_INLINE void find_extremes_of_disks() {
    const V away = gap(all(near_), balls_.depth, all(far_));
    disk_square_ = (balls_.radius - away) * (balls_.radius + away);
    const V half = root(disk_square_);
    upwards_ = {balls_.y - half, balls_.y + half};
    sideways_ = {balls_.x - half, balls_.x + half};
  }

  // `given`: SphereSetup::extremes.
  HWY_INLINE void find_extremes(const Quads& given) {
    is_precise_ = AllFalse(D(), And(are_balls_, balls_.inverse_upright == Zero(D())));
    const Hull sideways = {within(given.first), within(given.second)};
    const Hull upwards = {within(given.third), within(given.fourth)};
    const auto radius_at = [&](V inverse) { return balls_.half_chord(inverse, Zero(D())); };
    upwards_ = {balls_.y * upwards.low - radius_at(upwards.low), balls_.y * upwards.high + radius_at(upwards.high)};
    sideways_ = {(balls_.x - balls_.radius) * sideways.low, (balls_.x + balls_.radius) * sideways.high};
    farthest_left_ = balls_.y * sideways.low;
    farthest_right_ = balls_.y * sideways.high;
  }

  // See Certainty; for rows straight ahead. Balls that contain the slice's whole part of the view by more than their
  // slack have no ends there. An infinite radius marks a ball whose rows are decided exactly.
  HWY_INLINE V least_area() const {
    // Products that underflow must differ from the 0 of balls that contain all.
    constexpr float k_something = std::numeric_limits<float>::min();
    const V area = Max(all(8.2f) * (balls_.slack * balls_.radius) * (rate_ * rate_), all(k_something));
    const V surely = balls_.radius - all(4.0f) * balls_.slack;
    const M is_sure = And(surely > Zero(D()), surely < infinity());
    return IfThenZeroElse(And(is_sure, farthest_square() < surely * surely), area);
  }

  // An upper bound of the squared distance to the farthest point of the slice's part of the view. Balls smaller than
  // half of that part's width do not contain it anyway.
  HWY_INLINE V farthest_square() const {
    const float width = planes_->right - planes_->left;
    if (AllTrue(D(), balls_.radius < all(0.49f * width) * metres_per_slope(all(far_)))) return infinity();
    const V near = all(near_), far = all(far_);
    const V of_near = metres_per_slope(near), of_far = metres_per_slope(far);
    const auto farthest = [&](float low, V coordinate, float high) {
      return farther_end(Min(all(low) * of_near, all(low) * of_far), coordinate,
                         Max(all(high) * of_near, all(high) * of_far));
    };
    const V across = farthest(planes_->left, balls_.x, planes_->right);
    const V up = farthest(planes_->slope[static_cast<std::size_t>(planes_->rows)], balls_.y, planes_->slope.front());
    const V along = farther_end(near, balls_.depth, far);
    return across * across + up * up + along * along;
  }

  // The least (side = -1) or greatest (side = 1) slope x / depth in tile planes of some slopes.
  template <int side>
  HWY_INLINE V end_of(const Balls& ball, V slope) const {
    const auto go = [](V from, V by) { return side < 0 ? from - by : from + by; };
    const V away = ball.y - slope * ball.depth;
    const V tilt_square = all(1.0f) + slope * slope;
    const V chord = root(ball.radius * ball.radius * tilt_square - away * away);
    const V ahead = ball.depth + slope * ball.y;
    V touch = go(ahead, ball.lean * chord) * ball.inverse_upright;
    if (!is_precise_) touch = precise_touch<side>(ball, chord, ahead, tilt_square, touch);
    // If no tangent touches ahead of the eye, the ball grows towards it.
    const M is_ahead = touch > Zero(D());
    const V inverse = IfThenElse(is_ahead, within(touch), all(nearest_inverse_));
    const V offset = slope - ball.y * inverse;
    return go(ball.x * inverse, ball.half_chord(inverse, offset));
  }

  // The touch depth of the tangent, for balls for which inverse_upright is not precise enough.
  template <int side>
  static HWY_NOINLINE V precise_touch(const Balls& ball, V chord, V ahead, V tilt_square, V otherwise) {
    const V zero = Zero(D()), at_eye = all(SphereSetup::k_at_eye);
    const V ahead_square = (ball.depth - ball.radius) * (ball.depth + ball.radius);
    const V upright = ball.y * ball.y + ahead_square, x_square = ball.x * ball.x;
    const V sum = ahead + Abs(ball.lean) * chord;
    const V square = x_square + upright;
    const V from_eye = ahead * ahead + x_square * tilt_square;
    const V outer = IfThenElse(upright > zero, sum / upright, at_eye);
    const V inner = IfThenElse(sum > zero, from_eye / (square * sum), at_eye);
    const M is_outer = side < 0 ? ball.x < zero : ball.x >= zero;
    const V precise = IfThenElse(is_outer, outer, inner);
    return IfThenElse(ball.inverse_upright == zero, precise, otherwise);
  }

  // Uses the ball's half chord at a point in the row's part of the picture. A row is also certain if the distance
  // inwards from an end to the next boundary, in columns, times this half chord is at least 4 slack R rate (and some
  // for rounding), and its square is at least 4 slack R. `steepness` is least_area's.
  HWY_INLINE M is_certain_by_chord(const RowBall& at, const Table& slopes, V inwards, V steepness) const {
    const Balls ball = balls_.of(at.ball);
    // A point that is about as near to the centre as any.
    const V depth = Min(Max(ball.depth, all(near_)), all(far_)), along = ball.depth - depth;
    const V metres = metres_per_slope(depth);
    const V across = gap(all(planes_->left) * metres, ball.x, all(planes_->right) * metres);
    const V up = gap(slopes.at(at.row + all(1)) * metres, ball.y, slopes.at(at.row) * metres);
    const V half_square = ball.radius * ball.radius - (across * across + up * up + along * along);
    const V least = all(5.0f) * (ball.slack * ball.radius), way = least * taken(rate_, at.ball);
    // An infinite radius has no chord.
    return And(And(is_between(least, half_square, all(1e30f)), inwards >= Zero(D())),
               inwards * inwards * half_square >= way * way * steepness);
  }

  const RowPlanes* planes_;
  float near_, far_, nearest_inverse_, farthest_inverse_;  // depths of the slice's planes
  Balls balls_;
  VU lights_;
  M are_balls_;
  Hull upwards_;   // the balls' range in the slice, y / depth
  Hull sideways_;  // contains their range x / depth
  V rate_;         // the largest number of columns for a metre to the side
  V least_area_;   // for rows straight ahead; 0 for balls that contain the slice's part of the view
  // For perspective grids:
  V farthest_left_, farthest_right_;  // where balls extend farthest to a side, y / depth
  bool is_precise_;                   // is inverse_upright precise for all balls?
  // For orthographic grids:
  V disk_square_;  // squared radius of the balls' disks at the depth where they are largest
};

std::uint32_t lanes() {
  return static_cast<std::uint32_t>(Lanes(D()));
}

// The values of a batch before its columns: the rows that each ball may touch.
HWY_INLINE void start_batch(int grid_rows, const BallRows& rows, BatchSpans& out) {
  out.count = out.uncertain_count = 0;
  out.tests = static_cast<std::uint32_t>(GetLane(SumOfLanes(DI(), rows.count)));
  // A loop over all rows is predictable for the processor, unlike one whose bounds depend on the balls.
  constexpr int k_few_rows = 32;
  if (grid_rows <= k_few_rows) {
    out.first_row = 0;
    out.last_row = grid_rows - 1;
    return;
  }
  const MI touches = rows.count > Zero(DI());
  const VI end = IfThenElseZero(touches, rows.first + rows.count);
  out.first_row = GetLane(MinOfLanes(DI(), IfThenElse(touches, rows.first, all(grid_rows))));
  out.last_row = GetLane(MaxOfLanes(DI(), end)) - 1;
}

// The balls that may touch each row and do not contain all of it, row after row.
HWY_INLINE void list_row_balls(const BallRows& rows, BatchSpans& out) {
  std::uint32_t* HWY_RESTRICT row_balls = out.row_balls.data();
  std::uint32_t* HWY_RESTRICT sizes = out.sizes.data();
  std::uint32_t count = 0;
  const VU others = BitCast(DU(), IfThenZeroElse(rows.full, rows.count));
  VU skipped = BitCast(DU(), all(out.first_row) - rows.first);  // each ball's rows; large before its first one
  VU number = RowBall::all_of(out.first_row);
  for (int row = out.first_row, last = out.last_row; row <= last; ++row) {
    const auto wanted = skipped < others;
    store_wanted(number, wanted, row_balls + count);
    const auto size = static_cast<std::uint32_t>(CountTrue(DU(), wanted));
    sizes[row] = size;
    count += size;
    skipped = skipped + all(1u);
    number = number + all(1u << RowBall::k_lane_bits);
  }
  StoreU(Zero(DU()), DU(), row_balls + count);
  out.count = count;
}

// The hulls of the balls in all rows.
template <class Batch>
HWY_INLINE void find_hulls(const Table& slopes, const Batch& batch, BatchSpans& out) {
  const std::uint32_t *row_balls = out.row_balls.data(), count = out.count;
  for (std::uint32_t begin = 0; begin < count; begin += lane_count()) {
    const RowBall at(LoadU(DU(), row_balls + begin));
    const Hull hull = batch.hull_of(at.ball, slopes.at(at.row), slopes.at(at.row + all(1)));
    StoreU(hull.low, D(), out.low.data() + begin);
    StoreU(hull.high, D(), out.high.data() + begin);
  }
}

// Lists the uncertain ones of `count` spans, at most a vector of them, from span `first` on.
HWY_INLINE void list_uncertain(VU columns, std::uint32_t count, std::uint32_t first, BatchSpans& out) {
  const VU marks = And(columns, all(BatchSpans::k_first_is_uncertain | BatchSpans::k_last_is_uncertain));
  const auto is_marked = And(Ne(marks, Zero(DU())), FirstN(DU(), count));
  const auto is_uncertain = And(is_marked, Ne(columns, all(BatchRows::k_none)));
  if (AllFalse(DU(), is_uncertain)) return;
  const VU indices = BitCast(DU(), from_on(static_cast<std::int32_t>(first)));
  store_wanted(indices, is_uncertain, out.uncertain.data() + out.uncertain_count);
  out.uncertain_count += static_cast<std::uint32_t>(CountTrue(DU(), is_uncertain));
}

// The columns of all rows.
template <class Batch>
HWY_INLINE void find_columns(const Table& slopes, const Batch& batch, BatchSpans& out) {
  const std::uint32_t *row_balls = out.row_balls.data(), count = out.count;
  for (std::uint32_t begin = 0; begin < count; begin += lane_count()) {
    const RowBall at(LoadU(DU(), row_balls + begin));
    const Hull hull = {LoadU(D(), out.low.data() + begin), LoadU(D(), out.high.data() + begin)};
    const VU columns = batch.columns_of(at, slopes, hull, FirstN(D(), count - begin));
    StoreU(columns, DU(), out.columns.data() + begin);
    StoreU(BitCast(DU(), taken(BitCast(DI(), batch.lights()), at.ball)), DU(), out.lights.data() + begin);
    list_uncertain(columns, count - begin, begin, out);
  }
}

// Adds to each row the balls that contain all of it.
template <class Batch>
HWY_INLINE void add_full(const Batch& batch, const BallRows& rows, BatchSpans& out) {
  const VI end_of_others = IfThenZeroElse(rows.full, rows.first + rows.count);
  std::swap(out.row_balls, out.columns);
  const std::uint32_t* others = out.row_balls.data();  // their columns
  out.count = out.uncertain_count = 0;
  for (int row = out.first_row; row <= out.last_row; ++row) {
    std::uint32_t& size = out.sizes[static_cast<std::size_t>(row)];
    const MI found = And(rows.first < all(row + 1), all(row) < end_of_others);
    const auto wanted = RebindMask(DU(), Or(found, rows.full));
    const VU columns = IfThenElse(RebindMask(DU(), rows.full), batch.all_columns(),
                                  expanded(DU(), LoadU(DU(), others), RebindMask(DU(), found)));
    const VU listed = compressed(DU(), columns, wanted);
    StoreU(listed, DU(), out.columns.data() + out.count);
    store_wanted(batch.lights(), wanted, out.lights.data() + out.count);
    others += size;
    size = static_cast<std::uint32_t>(CountTrue(DU(), wanted));
    list_uncertain(listed, size, out.count, out);
    out.count += size;
  }
}

// Step by step for all batches, because the steps of one batch depend on each other.
template <bool orthographic>
HWY_INLINE void rows_of_batches(const RowPlanes& planes, const SphereSetup& shapes, std::span<const BallsOfSlice> balls,
                                RowBatches& out) {
  const std::size_t count = balls.size();
  const Table slopes(planes.slope, planes.rows + 1);
  Batch<orthographic> batches[k_batches_at_once];
  BallRows rows[k_batches_at_once];
  for (std::size_t i = 0; i < count; ++i) {
    batches[i].start(planes, shapes, balls[i]);
    rows[i] = batches[i].find_rows();
  }
  for (std::size_t i = 0; i < count; ++i) {
    start_batch(planes.rows, rows[i], out[i]);
    list_row_balls(rows[i], out[i]);
  }
  for (std::size_t i = 0; i < count; ++i) find_hulls(slopes, batches[i], out[i]);
  for (std::size_t i = 0; i < count; ++i) {
    find_columns(slopes, batches[i], out[i]);
    if (!AllFalse(DI(), rows[i].full)) add_full(batches[i], rows[i], out[i]);
  }
}

void rows_of(const RowPlanes& planes, const SphereSetup& shapes, std::span<const BallsOfSlice> balls, RowBatches& out) {
  if (planes.orthographic)
    rows_of_batches<true>(planes, shapes, balls, out);
  else
    rows_of_batches<false>(planes, shapes, balls, out);
}

}  // namespace
}  // namespace clusterbench::assign::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(lanes);
HWY_EXPORT(rows_of);

std::uint32_t balls_per_batch() {
  return HWY_DYNAMIC_DISPATCH(lanes)();
}

void find_rows(const RowPlanes& planes, const SphereSetup& shapes, std::span<const BallsOfSlice> balls,
               RowBatches& out) {
  for (BatchSpans& batch : out) batch.make_room(planes.rows);  // all of them, however many a machine needs
  HWY_DYNAMIC_DISPATCH(rows_of)(planes, shapes, balls, out);
}

}  // namespace clusterbench::assign
#endif
