#include "assign/simd/ball_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/row_slopes.h"
#include "grid/index_range.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assign/simd/ball_rows.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target
#include <hwy/highway.h>

#ifndef CLUSTERBENCH_BALL_ROWS_ONCE  // what all targets share
#define CLUSTERBENCH_BALL_ROWS_ONCE
namespace clusterbench::assign {

inline constexpr float k_nowhere = std::numeric_limits<float>::infinity();
inline constexpr std::size_t k_most_lanes = 64;  // of any target

// A ball as rows see it, and the rows and slices that it can touch.
struct SeenBall {
  float x, y, depth, larger, smaller;  // radii
  int first_plane, planes;             // tile planes first_plane .. first_plane + planes - 1
  int first_slice, last_slice;
};

// Where one slice's hulls go: per tile row from first_plane on, lows and highs of the larger and the smaller ball.
struct SliceHulls {
  float *low_outer, *high_outer, *low_inner, *high_inner;
};

}  // namespace clusterbench::assign
#endif

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;

// The circle that a vector of tile planes cuts out of a ball, seen within its plane: across and along the view.
struct Circle {
  V squared_radius, low, high;  // slopes of the two tangents
  V low_depth, high_depth;      // where they touch; behind the eye: below any slice
};

V infinity() {
  return hn::Set(D(), k_nowhere);
}

HWY_INLINE Circle circle_of(V x, V away, V w, V tilt, V inverse_tilt, V radius) {
  const D d;
  Circle circle;
  circle.squared_radius = hn::Mul(hn::Sub(radius, away), hn::Add(radius, away));
  const V ahead = hn::Add(hn::Mul(x, x), hn::Mul(w, w));
  const V rho = hn::Sqrt(hn::Max(circle.squared_radius, hn::Zero(d)));
  const V distance = hn::Sqrt(ahead);
  const V squared_tangent = hn::Mul(hn::Sub(distance, rho), hn::Add(distance, rho));
  const auto exists = hn::And(hn::Gt(squared_tangent, hn::Zero(d)), hn::Ge(circle.squared_radius, hn::Zero(d)));
  const V tangent = hn::Sqrt(hn::Max(squared_tangent, hn::Zero(d)));
  const V to_depth = hn::Div(hn::Mul(tangent, inverse_tilt), ahead);
  const V lean_low = hn::Add(hn::Mul(w, tangent), hn::Mul(x, rho));
  const V lean_high = hn::Sub(hn::Mul(w, tangent), hn::Mul(x, rho));
  const V none = hn::Set(d, -1.0f);
  circle.low_depth = hn::IfThenElse(exists, hn::Mul(to_depth, lean_low), none);
  circle.high_depth = hn::IfThenElse(exists, hn::Mul(to_depth, lean_high), none);
  circle.low = hn::Mul(tilt, hn::Div(hn::Sub(hn::Mul(x, tangent), hn::Mul(w, rho)), lean_low));
  circle.high = hn::Mul(tilt, hn::Div(hn::Add(hn::Mul(x, tangent), hn::Mul(w, rho)), lean_high));
  return circle;
}

// Slopes of the two corners of each tile plane's circle with a slice plane; +inf, -inf without.
HWY_INLINE void corners(V x, V squared_radius, V w, V tilt, float depth, float inverse_depth, V& low, V& high) {
  const D d;
  const V gap = hn::Sub(hn::Mul(hn::Set(d, depth), tilt), w);
  const V square = hn::Sub(squared_radius, hn::Mul(gap, gap));
  const auto exists = hn::Ge(square, hn::Zero(d));
  const V half = hn::Sqrt(hn::Max(square, hn::Zero(d))), inverse = hn::Set(d, inverse_depth);
  low = hn::IfThenElse(exists, hn::Mul(hn::Sub(x, half), inverse), infinity());
  high = hn::IfThenElse(exists, hn::Mul(hn::Add(x, half), inverse), hn::Neg(infinity()));
}

// Widens a slice's hulls by the tangents that touch in it.
HWY_INLINE void add_tangents(const Circle& circle, V depth0, V depth1, V& low, V& high) {
  const auto low_is_in = hn::And(hn::Ge(circle.low_depth, depth0), hn::Le(circle.low_depth, depth1));
  const auto high_is_in = hn::And(hn::Ge(circle.high_depth, depth0), hn::Le(circle.high_depth, depth1));
  low = hn::Min(low, hn::IfThenElse(low_is_in, circle.low, infinity()));
  high = hn::Max(high, hn::IfThenElse(high_is_in, circle.high, hn::Neg(infinity())));
}

// Hulls per tile plane and slice, for a vector of tile planes through all slices of the ball. `hulls`: slice after
// slice, `stride` floats for each of the four kinds.
void plane_hulls(const RowPlanes& planes, const SeenBall& ball, int offset, std::size_t stride, float* hulls) {
  const D d;
  const int plane = ball.first_plane + offset;
  const V slope = hn::LoadU(d, planes.slope.data() + plane), tilt = hn::LoadU(d, planes.tilt.data() + plane);
  const V inverse_tilt = hn::LoadU(d, planes.inverse_tilt.data() + plane);
  const V x = hn::Set(d, ball.x), y = hn::Set(d, ball.y), depth = hn::Set(d, ball.depth);
  const V away = hn::Mul(hn::Sub(y, hn::Mul(slope, depth)), inverse_tilt);
  const V w = hn::Mul(hn::Add(hn::Mul(slope, y), depth), inverse_tilt);
  const Circle outer = circle_of(x, away, w, tilt, inverse_tilt, hn::Set(d, ball.larger));
  const Circle inner = circle_of(x, away, w, tilt, inverse_tilt, hn::Set(d, ball.smaller));
  V low_outer, high_outer, low_inner, high_inner;
  const auto corners_at = [&](int slice, V& lo, V& ho, V& li, V& hi) {
    const auto k = static_cast<std::size_t>(slice);
    corners(x, outer.squared_radius, w, tilt, planes.depth[k], planes.inverse_depth[k], lo, ho);
    corners(x, inner.squared_radius, w, tilt, planes.depth[k], planes.inverse_depth[k], li, hi);
  };
  corners_at(ball.first_slice, low_outer, high_outer, low_inner, high_inner);
  float* to = hulls + offset;
  for (int slice = ball.first_slice; slice <= ball.last_slice; ++slice) {
    V next_lo, next_ho, next_li, next_hi;
    corners_at(slice + 1, next_lo, next_ho, next_li, next_hi);
    V lo = hn::Min(low_outer, next_lo), ho = hn::Max(high_outer, next_ho);
    V li = hn::Min(low_inner, next_li), hi = hn::Max(high_inner, next_hi);
    const V depth0 = hn::Set(d, planes.depth[static_cast<std::size_t>(slice)]);
    const V depth1 = hn::Set(d, planes.depth[static_cast<std::size_t>(slice) + 1]);
    add_tangents(outer, depth0, depth1, lo, ho);
    add_tangents(inner, depth0, depth1, li, hi);
    hn::StoreU(lo, d, to);
    hn::StoreU(ho, d, to + stride);
    hn::StoreU(li, d, to + 2 * stride);
    hn::StoreU(hi, d, to + 3 * stride);
    to += 4 * stride;
    low_outer = next_lo;
    high_outer = next_ho;
    low_inner = next_li;
    high_inner = next_hi;
  }
}

void all_plane_hulls(const RowPlanes& planes, const SeenBall& ball, std::size_t stride, float* hulls) {
  const int lanes = static_cast<int>(hn::Lanes(D()));
  for (int offset = 0; offset < ball.planes; offset += lanes) plane_hulls(planes, ball, offset, stride, hulls);
}

// Rows from planes: the hull of both. In place: row i reads planes i and i + 1.
void merge_planes(int rows, std::size_t stride, float* slice) {
  const D d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int i = 0; i < rows; i += lanes)
    for (const std::size_t kind : {0, 1, 2, 3}) {
      float* at = slice + kind * stride + i;
      const V a = hn::LoadU(d, at), b = hn::LoadU(d, at + 1);
      hn::StoreU(kind % 2 == 0 ? hn::Min(a, b) : hn::Max(a, b), d, at);
    }
}

// Which balls reach into the view: not wholly beyond a side plane, the nearest or the farthest depth.
std::uint32_t cull(const RowPlanes& planes, const float* x, const float* y, const float* z, const float* radius,
                   const float* slack, std::uint32_t count, std::uint32_t* kept) {
  const D d;
  const hn::RebindToUnsigned<D> du;
  const auto lanes = static_cast<std::uint32_t>(hn::Lanes(d));
  const std::size_t bottom = static_cast<std::size_t>(planes.rows);
  const auto side = [&](float slope) { return hn::Set(d, 1.0f / std::sqrt(1.0f + slope * slope)); };
  const V left = hn::Set(d, planes.left), right = hn::Set(d, planes.right);
  const V top = hn::Set(d, planes.slope[0]), low = hn::Set(d, planes.slope[bottom]);
  const V by_left = side(planes.left), by_right = side(planes.right);
  const V by_top = side(planes.slope[0]), by_low = side(planes.slope[bottom]);
  const V near = hn::Set(d, planes.depth.front()), far = hn::Set(d, planes.depth.back());
  std::uint32_t* to = kept;
  for (std::uint32_t i = 0; i < count; i += lanes) {
    const std::uint32_t left_over = std::min(lanes, count - i);
    const auto valid = hn::FirstN(d, left_over);
    const auto load = [&](const float* from) {
      if (left_over == lanes) return hn::LoadU(d, from + i);
      float rest[k_most_lanes] = {};
      std::copy(from + i, from + count, rest);
      return hn::LoadU(d, rest);
    };
    const V px = load(x), py = load(y), depth = hn::Neg(load(z)), given = load(radius);
    const V reach = hn::Add(given, load(slack));
    const V gap_x = hn::Max(hn::Mul(hn::Sub(hn::Mul(left, depth), px), by_left),
                            hn::Mul(hn::Sub(px, hn::Mul(right, depth)), by_right));
    const V gap_y =
        hn::Max(hn::Mul(hn::Sub(py, hn::Mul(top, depth)), by_top), hn::Mul(hn::Sub(hn::Mul(low, depth), py), by_low));
    const V gap_z = hn::Max(hn::Sub(near, depth), hn::Sub(depth, far));
    const V gap = hn::Max(gap_x, hn::Max(gap_y, gap_z));
    const auto wanted = hn::And(valid, hn::And(hn::Le(gap, reach), hn::Gt(given, hn::Zero(d))));
    const auto indices = hn::Iota(du, i);
    hn::StoreU(hn::Compress(indices, hn::RebindMask(du, wanted)), du, to);
    to += hn::CountTrue(d, wanted);
  }
  return static_cast<std::uint32_t>(to - kept);
}

}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(all_plane_hulls);
HWY_EXPORT(merge_planes);
HWY_EXPORT(cull);

namespace {

std::vector<float> padded(std::vector<float> list, float with) {
  list.resize(list.size() + k_most_lanes, with);
  return list;
}

// Row of tiles at a slope; those beyond the top are -1, beyond the bottom the number of rows. Slopes descend.
int row_at(const std::vector<float>& slopes, float slope) {
  return static_cast<int>(std::lower_bound(slopes.begin(), slopes.end(), slope, std::greater<>()) - slopes.begin()) - 1;
}

struct Slopes {
  float low, high;
};

// The sphere's own extremes at y = the centre's: its tangents, and the circles in the slice planes. Each lies in one
// row.
class LevelPoints {
 public:
  LevelPoints(const RowPlanes& planes, const SeenBall& ball, std::size_t stride, float* hulls)
      : planes_(planes), ball_(ball), stride_(stride), hulls_(hulls) {}

  void add_all() {
    for (int plane = ball_.first_slice; plane <= ball_.last_slice + 1; ++plane) add_slice_plane(plane);
    add_tangents(ball_.larger, k_outer);
    if (ball_.smaller > 0.0f) add_tangents(ball_.smaller, k_inner);
  }

 private:
  static constexpr std::size_t k_outer = 0, k_inner = 2;

  void add_slice_plane(int plane) {
    const auto k = static_cast<std::size_t>(plane);
    const float gap = planes_.depth[k] - ball_.depth, inverse = planes_.inverse_depth[k];
    const float square = ball_.larger * ball_.larger - gap * gap;
    if (!(square >= 0.0f)) return;
    const int row = row_at(planes_.row_slope, ball_.y * inverse);
    add_chord(plane, row, std::sqrt(square) * inverse, inverse, k_outer);
    const float smaller = ball_.smaller * ball_.smaller - gap * gap;
    if (smaller >= 0.0f && ball_.smaller > 0.0f) add_chord(plane, row, std::sqrt(smaller) * inverse, inverse, k_inner);
  }

  void add_chord(int plane, int row, float half, float inverse, std::size_t kind) {
    const float middle = ball_.x * inverse;
    widen(plane - 1, row, kind, middle - half, middle + half);
    widen(plane, row, kind, middle - half, middle + half);
  }

  void add_tangents(float radius, std::size_t kind) {
    const float ahead = ball_.x * ball_.x + ball_.depth * ball_.depth, distance = std::sqrt(ahead);
    const float squared = (distance - radius) * (distance + radius);
    if (!(squared > 0.0f)) return;
    const float tangent = std::sqrt(squared);
    for (const float side : {-radius, radius}) {
      const float lean = ball_.depth * tangent - ball_.x * side, depth = tangent / ahead * lean;
      if (!(depth > 0.0f)) continue;
      const auto above = std::upper_bound(planes_.depth.begin(), planes_.depth.end(), depth);
      const float slope = (ball_.x * tangent + ball_.depth * side) / lean;
      widen(static_cast<int>(above - planes_.depth.begin()) - 1, row_at(planes_.row_slope, ball_.y / depth), kind,
            slope, slope);
    }
  }

  void widen(int slice, int row, std::size_t kind, float low, float high) {
    const int place = row - ball_.first_plane;
    if (slice < ball_.first_slice || slice > ball_.last_slice || place < 0 || place >= ball_.planes - 1) return;
    float* at = hulls_ + (static_cast<std::size_t>(slice - ball_.first_slice) * 4 + kind) * stride_ + place;
    at[0] = std::min(at[0], low);
    at[stride_] = std::max(at[stride_], high);
  }

  const RowPlanes& planes_;
  const SeenBall& ball_;
  std::size_t stride_;
  float* hulls_;
};

}  // namespace

RowPlanes::RowPlanes(const grid::ScreenGrid& grid)
    : row_slope(grid.tiles.y),
      rows(grid.tiles.count.y),
      columns(grid.tiles.count.x),
      left(grid.tiles.x.front()),
      right(grid.tiles.x.back()) {
  for (const float s : grid.tiles.y) {
    const double t = std::sqrt(1.0 + static_cast<double>(s) * static_cast<double>(s));
    tilt.push_back(static_cast<float>(t));
    inverse_tilt.push_back(static_cast<float>(1.0 / t));
  }
  slope = padded(grid.tiles.y, 0.0f);
  tilt = padded(tilt, 1.0f);
  inverse_tilt = padded(inverse_tilt, 1.0f);
  for (const float z : grid.slices.boundaries) {
    depth.push_back(z);
    inverse_depth.push_back(z > 0.0f ? 1.0f / z : 1e30f);  // at the eye every slope but 0 is beyond the picture
  }
  // The edge tile may be clipped: the first one tells the width.
  columns_per_slope = 1.0f / (grid.tiles.x[1] - grid.tiles.x[0]);
}

void cull_balls(const RowPlanes& planes, const float* x, const float* y, const float* z, const float* radius,
                const float* slack, std::uint32_t count, std::vector<std::uint32_t>& kept) {
  kept.resize(count + k_most_lanes);
  kept.resize(HWY_DYNAMIC_DISPATCH(cull)(planes, x, y, z, radius, slack, count, kept.data()));
}

namespace {

// Columns of a hull, as far as `margin` columns of error allow: towards the outside for a positive margin.
struct Columns {
  int first, last;
};
Columns columns_of(const RowPlanes& planes, float low, float high, float margin) {
  const float scale = planes.columns_per_slope, most = static_cast<float>(planes.columns);
  const float from = (low - planes.left) * scale - margin, to = (high - planes.left) * scale + margin;
  const float end = (planes.right - planes.left) * scale;
  if (!(from <= to) || to < 0.0f || from > end) return {1, 0};
  return {static_cast<int>(std::max(from, 0.0f)), static_cast<int>(std::min(std::max(to, 0.0f), most - 1.0f))};
}

}  // namespace

void find_rows(const RowPlanes& planes, const geom::Ball& ball, float slack, std::vector<float>& scratch,
               std::vector<TouchedRow>& rows) {
  SeenBall seen{ball.center.x, ball.center.y, -ball.center.z, ball.radius + slack, ball.radius - slack, 0, 0, 0, 0};
  const grid::IndexRange slices =
      grid::intervals_touched(planes.depth, seen.depth - seen.larger, seen.depth + seen.larger);
  if (slices.empty()) return;
  seen.first_slice = slices.first;
  seen.last_slice = slices.last;
  geom::SlopeHull<float> upright;
  geom::add_disk(upright, seen.y, seen.depth, seen.larger * seen.larger,
                 planes.depth[static_cast<std::size_t>(slices.first)],
                 planes.depth[static_cast<std::size_t>(slices.last) + 1], 1.0f);
  const grid::IndexRange touched = grid::descending_intervals_touched(planes.row_slope, upright.lo, upright.hi);
  if (touched.empty()) return;
  seen.first_plane = touched.first;
  seen.planes = touched.count() + 1;

  const std::size_t stride = static_cast<std::size_t>(seen.planes) + k_most_lanes;
  const auto slice_count = static_cast<std::size_t>(slices.count());
  if (scratch.size() < slice_count * 4 * stride) scratch.resize(slice_count * 4 * stride);
  HWY_DYNAMIC_DISPATCH(all_plane_hulls)(planes, seen, stride, scratch.data());
  for (std::size_t slice = 0; slice < slice_count; ++slice)
    HWY_DYNAMIC_DISPATCH(merge_planes)(touched.count(), stride, scratch.data() + slice * 4 * stride);
  LevelPoints(planes, seen, stride, scratch.data()).add_all();

  // What the scale and the planes' own rounding can be off by, in columns.
  const float margin = 0x1p-19f * static_cast<float>(planes.columns + 1);
  for (std::size_t slice = 0; slice < slice_count; ++slice) {
    const float* at = scratch.data() + slice * 4 * stride;
    for (int i = 0; i < touched.count(); ++i, ++at) {
      const Columns outer = columns_of(planes, at[0], at[stride], margin);
      if (outer.first > outer.last) continue;
      Columns inner{1, 0};
      if (seen.smaller > 0.0f) inner = columns_of(planes, at[2 * stride], at[3 * stride], -margin);
      const int row = (slices.first + static_cast<int>(slice)) * planes.rows + touched.first + i;
      rows.push_back({static_cast<std::uint32_t>(row), static_cast<std::uint16_t>(outer.first),
                      static_cast<std::uint16_t>(outer.last), static_cast<std::uint16_t>(inner.first),
                      static_cast<std::uint16_t>(inner.last)});
    }
  }
}

}  // namespace clusterbench::assign
#endif
