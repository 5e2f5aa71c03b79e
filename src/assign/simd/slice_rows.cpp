#include "assign/simd/slice_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assign/simd/slice_rows.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target
#include <hwy/highway.h>

#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {
namespace {

V infinity() {
  return all(std::numeric_limits<float>::infinity());
}
V root(V square) {
  return hn::Sqrt(hn::Max(square, hn::Zero(D())));
}
M is_between(V low, V value, V high) {
  return hn::And(hn::Le(low, value), hn::Le(value, high));
}

// The interval of slopes found so far, per lane.
struct Hull {
  V low, high;

  HWY_INLINE void add(M where, V value) {
    low = hn::Min(low, hn::IfThenElse(where, value, infinity()));
    high = hn::Max(high, hn::IfThenElse(where, value, hn::Neg(infinity())));
  }
  HWY_INLINE void add(M where, V least, V greatest) {
    low = hn::Min(low, hn::IfThenElse(where, least, infinity()));
    high = hn::Max(high, hn::IfThenElse(where, greatest, hn::Neg(infinity())));
  }
  HWY_INLINE void add(const Hull& other) {
    low = hn::Min(low, other.low);
    high = hn::Max(high, other.high);
  }
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

// The slice's two planes and what the balls of a batch have to do with them.
struct SlicePlane {
  float depth, inverse;
  V chord_square;  // of the circle that the plane cuts out of the ball
  M cuts;
};

HWY_INLINE SlicePlane slice_plane(float depth, float inverse, V ball_depth, V radius) {
  const V gap = hn::Sub(all(depth), ball_depth);
  const V square = hn::Mul(hn::Sub(radius, gap), hn::Add(radius, gap));
  return {depth, inverse, square, hn::Ge(square, hn::Zero(D()))};
}

// Rows of one batch. Rows lie between tile planes; a plane's hull belongs to the row above it and to the one below.
class Batch {
 public:
  HWY_INLINE Batch(const RowPlanes& planes, const SeenBalls& seen, int slice, const std::uint32_t* balls)
      : planes_(planes) {
    const VI at = hn::BitCast(DI(), hn::LoadU(hn::RebindToUnsigned<DI>(), balls));
    x_ = gathered(seen.x, at);
    y_ = gathered(seen.y, at);
    depth_ = gathered(seen.depth, at);
    radius_ = gathered(seen.radius, at);
    slack_ = gathered(seen.slack, at);
    const auto k = static_cast<std::size_t>(slice);
    near_ = slice_plane(planes.depth[k], planes.inverse_depth[k], depth_, radius_);
    far_ = slice_plane(planes.depth[k + 1], planes.inverse_depth[k + 1], depth_, radius_);
  }

  // The rows that each ball may touch, from its extremes y / depth. `wanted`: the lanes that hold a ball.
  HWY_INLINE void find_rows(M wanted, VI& first, VI& count) const {
    Hull hull = empty_hull();
    const V distance = root(hn::Add(hn::Mul(y_, y_), hn::Mul(depth_, depth_)));
    const V tangent = root(hn::Mul(hn::Sub(distance, radius_), hn::Add(distance, radius_)));
    const Tangents tangents = tangents_of(y_, depth_, radius_, tangent, all(near_.depth), all(far_.depth));
    hull.add(tangents.low_is_in, tangents.low);
    hull.add(tangents.high_is_in, tangents.high);
    for (const SlicePlane* plane : {&near_, &far_}) add_chord(*plane, y_, plane->chord_square, hull);
    const V top = all(planes_.slope.front()), bottom = all(planes_.slope[static_cast<std::size_t>(planes_.rows)]);
    const M touches = hn::And(wanted, hn::And(hn::Le(hull.low, hn::Min(hull.high, top)), hn::Ge(hull.high, bottom)));
    const V scale = all(planes_.rows_per_slope), margin = all(planes_.row_margin);
    const V from = hn::Mul(hn::Sub(top, hn::Min(hull.high, top)), scale);
    const V to = hn::Mul(hn::Sub(top, hn::Max(hull.low, bottom)), scale);
    const VI last_row = hn::Set(DI(), planes_.rows - 1);
    first = hn::Min(hn::ConvertTo(DI(), hn::Max(hn::Sub(from, margin), hn::Zero(D()))), last_row);
    const VI last = hn::Min(hn::ConvertTo(DI(), hn::Add(to, margin)), last_row);
    count = hn::IfThenElseZero(hn::RebindMask(DI(), touches), hn::Add(hn::Sub(last, first), hn::Set(DI(), 1)));
  }

  // `known`: the lanes whose balls are the lights themselves.
  HWY_INLINE void start_level(M known) {
    const V distance = root(hn::Add(hn::Mul(x_, x_), hn::Mul(depth_, depth_)));
    const V tangent = root(hn::Mul(hn::Sub(distance, radius_), hn::Add(distance, radius_)));
    tangents_ = tangents_of(x_, depth_, radius_, tangent, all(near_.depth), all(far_.depth));
    const V inverse = hn::Div(all(1.0f), tangents_.square);
    tangents_.low_depth = hn::Mul(tangents_.low_depth, inverse);
    tangents_.high_depth = hn::Mul(tangents_.high_depth, inverse);
    near_chord_ = far_chord_ = empty_hull();
    add_chord(near_, x_, near_.chord_square, near_chord_);
    add_chord(far_, x_, far_.chord_square, far_chord_);
    // Distance from the eye to where its tangents touch, the same in all planes through the eye.
    const V from_eye = root(hn::Add(hn::Add(hn::Mul(x_, x_), hn::Mul(y_, y_)), hn::Mul(depth_, depth_)));
    tangent_ = root(hn::Mul(hn::Sub(from_eye, radius_), hn::Add(from_eye, radius_)));
    // Certainty, below.
    const V rate = all(planes_.columns_per_slope * near_.inverse);
    const float steepest = std::max(planes_.left * planes_.left, planes_.right * planes_.right);
    const V factor = all(8.2f * (1.0f + steepest));
    const V area = hn::Mul(hn::Mul(factor, hn::Mul(slack_, radius_)), hn::Mul(rate, rate));
    least_area_ = hn::IfThenElse(known, area, infinity());
  }

  // What lies in tile plane `place`, between the slice's planes.
  HWY_INLINE Hull plane_hull(VI place, V& slope) const {
    slope = gathered(planes_.slope, place);
    const V tilt = gathered(planes_.tilt, place), inverse = gathered(planes_.inverse_tilt, place);
    const V away = hn::Mul(hn::Sub(y_, hn::Mul(slope, depth_)), inverse);
    const V ahead = hn::Mul(hn::Add(hn::Mul(slope, y_), depth_), inverse);
    const V square = hn::Mul(hn::Sub(radius_, away), hn::Add(radius_, away));
    const M cuts = hn::Ge(square, hn::Zero(D()));
    Hull hull = empty_hull();
    Tangents tangents =
        tangents_of(x_, ahead, root(square), tangent_, hn::Mul(all(near_.depth), tilt), hn::Mul(all(far_.depth), tilt));
    hull.add(hn::And(cuts, tangents.low_is_in), hn::Mul(tilt, tangents.low));
    hull.add(hn::And(cuts, tangents.high_is_in), hn::Mul(tilt, tangents.high));
    for (const SlicePlane* plane : {&near_, &far_}) {
      const V up = hn::Sub(hn::Mul(slope, all(plane->depth)), y_);
      add_chord(*plane, x_, hn::Sub(plane->chord_square, hn::Mul(up, up)), hull);
    }
    return hull;
  }

  // The sphere's own extremes at the centre's height, where that is between two tile planes.
  HWY_INLINE void add_level(V top, V bottom, Hull& hull) const {
    const auto is_level = [&](V depth) { return is_between(hn::Mul(bottom, depth), y_, hn::Mul(top, depth)); };
    hull.add(is_level(all(near_.depth)), near_chord_.low, near_chord_.high);
    hull.add(is_level(all(far_.depth)), far_chord_.low, far_chord_.high);
    hull.add(hn::And(tangents_.low_is_in, is_level(tangents_.low_depth)), tangents_.low);
    hull.add(hn::And(tangents_.high_is_in, is_level(tangents_.high_depth)), tangents_.high);
  }

  // Certainty. The hull is that of a ball between the given one and the given one with twice the slack, d. Let m be the
  // row's point nearest to the centre, g away, and w = sqrt(R² - g²) for the larger radius R. A point p of the larger
  // ball in the row is within w of m; moved towards m by the share d / (R - g) of that it is in the given ball, and
  // still in the row. That is d w / (R - g) = d (R + g) / w <= 2 d R / w far. Seen from the eye a metre is at most
  // q = sqrt(1 + steepest²) / near of slope, so the given ball's extremes are within e = 2 d R q / w of the hull's. The
  // hull's width in the picture, h, is at most 2 w q; so e <= 4 d R q² / h. The columns are certainly right if the
  // hull's ends are farther than e from the next boundary inwards: that is, if that distance times h is at least
  // 4 d R q² = 8 slack R q², in columns the `least_area_`. And the given ball reaches the row at all if R - g >= d,
  // which follows from h² >= 8 d R q².
  HWY_INLINE V columns_of(const Hull& hull, M wanted) const {
    const V left = all(planes_.left), right = all(planes_.right), scale = all(planes_.columns_per_slope);
    const V margin = all(planes_.column_margin), one = all(1.0f);
    const M touches = hn::And(wanted, hn::And(hn::Le(hull.low, hn::Min(hull.high, right)), hn::Ge(hull.high, left)));
    const V from = hn::Mul(hn::Sub(hn::Max(hull.low, left), left), scale);
    const V to = hn::Mul(hn::Sub(hn::Min(hull.high, right), left), scale);
    const V last_column = all(static_cast<float>(planes_.columns - 1));
    const V first = hn::Min(hn::Floor(hn::Max(hn::Sub(from, margin), hn::Zero(D()))), last_column);
    const V last = hn::Min(hn::Floor(hn::Add(to, margin)), last_column);
    const V width = hn::Sub(to, from);
    const V inwards = hn::Sub(hn::Min(hn::Sub(hn::Add(first, one), from), hn::Sub(to, last)), margin);
    const M is_certain = hn::And(hn::Ge(hn::Mul(inwards, width), least_area_),
                                 hn::Ge(hn::Mul(width, width), hn::Add(least_area_, least_area_)));
    const hn::RebindToUnsigned<D> du;
    const auto ends = hn::Or(hn::BitCast(du, hn::ConvertTo(DI(), first)),
                             hn::ShiftLeft<16>(hn::BitCast(du, hn::ConvertTo(DI(), last))));
    const auto marked =
        hn::IfThenElse(hn::RebindMask(du, is_certain), ends, hn::Or(ends, hn::Set(du, BatchRows::k_uncertain)));
    const auto found = hn::IfThenElse(hn::RebindMask(du, touches), marked, hn::Set(du, BatchRows::k_none));
    return hn::BitCast(D(), found);
  }

 private:
  // Slopes of the ends of a chord in a slice's plane.
  HWY_INLINE static void add_chord(const SlicePlane& plane, V middle, V square, Hull& hull) {
    const V half = root(square), inverse = all(plane.inverse);
    hull.add(hn::Ge(square, hn::Zero(D())), hn::Mul(hn::Sub(middle, half), inverse),
             hn::Mul(hn::Add(middle, half), inverse));
  }

  const RowPlanes& planes_;
  V x_, y_, depth_, radius_, slack_;
  SlicePlane near_, far_;
  V tangent_, least_area_;
  Tangents tangents_;
  Hull near_chord_, far_chord_;
};

std::uint32_t lanes() {
  return static_cast<std::uint32_t>(hn::Lanes(D()));
}

void rows_of_batch(const RowPlanes& planes, const SeenBalls& seen, int slice, const std::uint32_t* balls,
                   std::uint32_t count, std::uint32_t first_bound, BatchRows& out) {
  const D d;
  const DI di;
  const hn::RebindToUnsigned<D> du;
  const std::size_t n = hn::Lanes(d);
  Batch batch(planes, seen, slice, balls);
  VI first, rows;
  batch.find_rows(hn::FirstN(d, count), first, rows);
  out.lanes = static_cast<std::uint32_t>(n);
  out.tests = static_cast<std::uint32_t>(hn::GetLane(hn::SumOfLanes(di, rows)));
  if (out.tests == 0) {
    out.last_row = out.first_row - 1;
    return;
  }
  const int most = hn::GetLane(hn::MaxOfLanes(di, rows));
  const auto touches = hn::Gt(rows, hn::Zero(di));
  const VI end = hn::Add(first, rows), last_plane = hn::Set(di, planes.rows);
  out.first_row = hn::GetLane(hn::MinOfLanes(di, hn::IfThenElse(touches, first, last_plane)));
  out.last_row = hn::GetLane(hn::MaxOfLanes(di, hn::IfThenElseZero(touches, end))) - 1;
  // One row more than the grid has, for what lanes write that are done.
  const std::size_t size = (static_cast<std::size_t>(planes.rows) + 1) * n;
  if (out.columns.size() < size) out.columns.resize(size);
  for (int row = out.first_row; row <= out.last_row; ++row)
    hn::StoreU(hn::Set(du, BatchRows::k_none), du, out.columns.data() + static_cast<std::size_t>(row) * n);

  const auto lights = hn::GatherIndex(du, seen.light.data(), hn::BitCast(di, hn::LoadU(du, balls)));
  hn::StoreU(lights, du, out.lights);
  batch.start_level(hn::RebindMask(d, hn::Lt(lights, hn::Set(du, first_bound))));
  V top, bottom;
  Hull above = batch.plane_hull(hn::Min(first, last_plane), top);
  VI place = first, to = hn::Add(hn::Mul(first, hn::Set(di, static_cast<std::int32_t>(n))), hn::Iota(di, 0));
  const VI step = hn::Set(di, static_cast<std::int32_t>(n)), one = hn::Set(di, 1);
  const VI done = hn::Set(di, planes.rows * static_cast<std::int32_t>(n));
  for (int row = 0; row < most; ++row) {
    const auto wanted = hn::Gt(rows, hn::Set(di, row));
    place = hn::Add(place, one);
    const Hull below = batch.plane_hull(hn::Min(place, last_plane), bottom);
    Hull hull = above;
    hull.add(below);
    batch.add_level(top, bottom, hull);
    const V columns = batch.columns_of(hull, hn::RebindMask(d, wanted));
    hn::ScatterIndex(hn::BitCast(di, columns), di, reinterpret_cast<std::int32_t*>(out.columns.data()),
                     hn::IfThenElse(wanted, to, done));
    to = hn::Add(to, step);
    above = below;
    top = bottom;
  }
}

// The sides of the picture as planes through the eye, and the grid's ends in depth.
class View {
 public:
  explicit View(const RowPlanes& planes)
      : left_(side(planes.left)),
        right_(side(planes.right)),
        top_(side(planes.slope.front())),
        bottom_(side(planes.slope[static_cast<std::size_t>(planes.rows)])),
        near_(planes.depth.front()),
        far_(planes.depth.back()) {}

  // How far a place is outside, at least.
  HWY_INLINE V gap(V x, V y, V depth) const {
    const V across = hn::Max(hn::Neg(left_.beyond(x, depth)), right_.beyond(x, depth));
    const V up = hn::Max(top_.beyond(y, depth), hn::Neg(bottom_.beyond(y, depth)));
    const V along = hn::Max(hn::Sub(all(near_), depth), hn::Sub(depth, all(far_)));
    return hn::Max(across, hn::Max(up, along));
  }

 private:
  struct Side {
    float slope, length;

    HWY_INLINE V beyond(V place, V depth) const {
      return hn::Mul(hn::Sub(place, hn::Mul(all(slope), depth)), all(length));
    }
  };
  static Side side(float slope) { return {slope, 1.0f / std::sqrt(1.0f + slope * slope)}; }

  Side left_, right_, top_, bottom_;
  float near_, far_;
};

// How many of the slice planes 1 .. `most` are below a depth (or at it, with or_at).
template <bool or_at>
HWY_INLINE VI planes_below(const RowPlanes& planes, V depth, int most) {
  const DI di;
  VI below = hn::Zero(di);
  for (auto step = static_cast<std::int32_t>(planes.searched.size() / 2); step > 0; step /= 2) {
    const VI probe = hn::Add(below, hn::Set(di, step));
    const V at = gathered(planes.searched, probe);
    const M is_below = or_at ? hn::Le(at, depth) : hn::Lt(at, depth);
    below = hn::IfThenElse(hn::RebindMask(di, is_below), probe, below);
  }
  return hn::Min(below, hn::Set(di, most));
}

// Reaches whose fourth powers, and these times a slope, are normal numbers.
constexpr float k_least_reach = 1e-9f, k_most_reach = 1e9f;

void see(const RowPlanes& planes, const GivenBalls& balls, std::uint32_t first_light, SeenBalls& seen,
         float roundings) {
  const D d;
  const DI di;
  const hn::RebindToUnsigned<D> du;
  const auto n = static_cast<std::uint32_t>(hn::Lanes(d));
  const View view(planes);
  for (std::uint32_t i = 0; i < balls.count; i += n) {
    const std::uint32_t left = std::min(n, balls.count - i);
    const auto load = [&](const float* from) { return loaded(from + i, left); };
    const V x = load(balls.x), y = load(balls.y), depth = hn::Neg(load(balls.z)), given = load(balls.radius);
    const V reach = load(balls.reach), slack = hn::Mul(reach, all(roundings * 0x1p-24f));
    const V radius = hn::Add(given, slack);
    const M reaches = hn::And(hn::Le(view.gap(x, y, depth), radius), hn::Gt(given, hn::Zero(d)));
    const M wanted = hn::And(reaches, hn::FirstN(d, left));
    const std::size_t kept = hn::CountTrue(d, wanted);
    if (kept == 0) continue;
    const auto keep = [&](V value, std::vector<float>& to) {
      hn::StoreU(hn::Compress(value, wanted), d, to.data() + seen.count);
    };
    keep(x, seen.x);
    keep(y, seen.y);
    keep(depth, seen.depth);
    // Powers of a reach must be normal numbers; elsewhere the whole grid is left to be decided.
    const M is_plain = is_between(all(k_least_reach), reach, all(k_most_reach));
    keep(hn::IfThenElse(is_plain, radius, infinity()), seen.radius);
    keep(slack, seen.slack);
    const auto lights = hn::Iota(du, first_light + i);
    hn::StoreU(hn::Compress(lights, hn::RebindMask(du, wanted)), du, seen.light.data() + seen.count);
    const auto keep_slice = [&](VI value, std::vector<std::int32_t>& to) {
      hn::StoreU(hn::Compress(value, hn::RebindMask(di, wanted)), di, to.data() + seen.count);
    };
    keep_slice(planes_below<false>(planes, hn::Sub(depth, radius), planes.slices - 1), seen.first_slice);
    keep_slice(planes_below<true>(planes, hn::Add(depth, radius), planes.slices - 1), seen.last_slice);
    seen.count += static_cast<std::uint32_t>(kept);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(lanes);
HWY_EXPORT(rows_of_batch);
HWY_EXPORT(see);

namespace {

std::vector<float> padded(std::vector<float> list, std::size_t size, float with) {
  list.resize(size, with);
  return list;
}

// Tiles per slope along one axis, and by how many tiles (slope - first plane) * scale can be off: planes are rounded,
// so they are not quite evenly spaced, and the last tile may be clipped; then difference and product are rounded.
struct Scale {
  float tiles_per_slope, margin;
};

Scale scale_of(const std::vector<float>& planes) {
  const std::size_t tiles = planes.size() - 1, even = std::max<std::size_t>(1, tiles - 1);
  const auto from_first = [&](std::size_t i) {
    return std::fabs(static_cast<double>(planes[i]) - static_cast<double>(planes[0]));
  };
  const auto scale = static_cast<float>(static_cast<double>(even) / from_first(even));
  double off = 0.0;
  for (std::size_t i = 0; i <= even; ++i)
    off = std::max(off, std::fabs(from_first(i) * static_cast<double>(scale) - static_cast<double>(i)));
  const double rounding = 0x1p-22 * static_cast<double>(tiles + 1);
  return {scale, static_cast<float>(1.1 * off + rounding)};
}

}  // namespace

RowPlanes::RowPlanes(const grid::ScreenGrid& grid)
    : rows(grid.tiles.count.y),
      columns(grid.tiles.count.x),
      slices(grid.slices.count()),
      left(grid.tiles.x.front()),
      right(grid.tiles.x.back()) {
  const Scale across = scale_of(grid.tiles.x), down = scale_of(grid.tiles.y);
  columns_per_slope = across.tiles_per_slope;
  column_margin = across.margin;
  rows_per_slope = down.tiles_per_slope;
  row_margin = down.margin;
  for (const float s : grid.tiles.y) {
    const double t = std::sqrt(1.0 + static_cast<double>(s) * static_cast<double>(s));
    slope.push_back(s);
    tilt.push_back(static_cast<float>(t));
    inverse_tilt.push_back(static_cast<float>(1.0 / t));
  }
  for (const float z : grid.slices.boundaries) {
    depth.push_back(z);
    inverse_depth.push_back(z > 0.0f ? 1.0f / z : 1e30f);  // at the eye every slope but 0 is beyond the picture
  }
  side = padded(grid.tiles.x, grid.tiles.x.size() + k_most_lanes, 0.0f);
  searched = padded(depth, std::bit_ceil(depth.size()), std::numeric_limits<float>::infinity());
}

void SeenBalls::reserve(std::uint32_t most) {
  const std::size_t size = most + k_most_lanes;
  for (std::vector<float>* list : {&x, &y, &depth, &radius, &slack})
    if (list->size() < size) list->resize(size);
  for (std::vector<std::int32_t>* list : {&first_slice, &last_slice})
    if (list->size() < size) list->resize(size);
  if (light.size() < size) light.resize(size);
}

std::size_t SeenBalls::capacity_bytes() const {
  return 8 * sizeof(float) * light.capacity();
}

void see_balls(const RowPlanes& planes, const GivenBalls& balls, std::uint32_t first_light, SeenBalls& seen,
               float roundings) {
  HWY_DYNAMIC_DISPATCH(see)(planes, balls, first_light, seen, roundings);
}

std::uint32_t balls_per_batch() {
  return HWY_DYNAMIC_DISPATCH(lanes)();
}

void find_rows(const RowPlanes& planes, const SeenBalls& seen, int slice, const std::uint32_t* balls,
               std::uint32_t count, std::uint32_t first_bound, BatchRows& out) {
  HWY_DYNAMIC_DISPATCH(rows_of_batch)(planes, seen, slice, balls, count, first_bound, out);
}

}  // namespace clusterbench::assign
#endif
