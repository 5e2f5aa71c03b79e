#include "assign/simd/cell_boxes.h"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assign/simd/cell_boxes.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target
#include <hwy/highway.h>

#include "assign/simd/boundaries-inl.h"
#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {
namespace {

// --- The slopes of disks in double precision: the twin of geom/tangents.cpp ---

using DD = hn::ScalableTag<double>;
using DF = hn::Rebind<float, DD>;  // as many lanes
using VD = hn::Vec<DD>;
using VF = hn::Vec<DF>;
using MD = hn::Mask<DD>;

constexpr double k_epsilon = std::numeric_limits<double>::epsilon();

VD all(double value) {
  return hn::Set(DD(), value);
}
VD infinity() {
  return all(std::numeric_limits<double>::infinity());
}

// The float below or at a value that is nearest to it.
HWY_INLINE VF rounded_down(VD value) {
  const DF df;
  const hn::RebindToUnsigned<DF> du;
  const VF nearest = hn::DemoteTo(df, value);
  const auto bits = hn::BitCast(du, nearest);
  const auto is_negative = hn::TestBit(bits, hn::Set(du, 0x80000000));
  const auto one = hn::Set(du, 1);
  const VF below = hn::BitCast(df, hn::IfThenElse(is_negative, hn::Add(bits, one), hn::Sub(bits, one)));
  // Where the double is smaller, brought to the float's lanes as a number.
  const VF is_above = hn::DemoteTo(df, hn::IfThenElseZero(hn::Gt(hn::PromoteTo(DD(), nearest), value), all(1.0)));
  return hn::IfThenElse(hn::Gt(is_above, hn::Zero(df)), below, nearest);
}

HWY_INLINE VF rounded_up(VD value) {
  return hn::Neg(rounded_down(hn::Neg(value)));
}

HWY_INLINE VD reach_past(VD line, VD depth, VD r) {
  const VD small = hn::Min(line, depth), large = hn::Max(line, depth);
  return hn::IfThenElse(hn::Ge(small, hn::Mul(all(0.5), large)), hn::Sub(r, hn::Sub(large, small)),
                        hn::Add(hn::Sub(r, large), small));
}

struct Hull {
  VD low, high;

  HWY_INLINE void add(MD where, VD value, VD error) {
    low = hn::Min(low, hn::IfThenElse(where, hn::Sub(value, error), infinity()));
    high = hn::Max(high, hn::IfThenElse(where, hn::Add(value, error), hn::Neg(infinity())));
  }
  // At depth 0 the slope is infinite, on both sides where the side is not certain.
  HWY_INLINE void add_slope(MD where, VD u, VD depth, VD u_error) {
    const MD ahead = hn::Gt(depth, hn::Zero(DD()));
    const VD slope = hn::Div(u, depth);
    add(hn::And(where, ahead), slope, hn::Add(hn::Div(u_error, depth), hn::Mul(all(2.0 * k_epsilon), hn::Abs(slope))));
    if (hn::AllTrue(DD(), ahead)) return;
    const MD beside = hn::AndNot(ahead, where);
    high = hn::IfThenElse(hn::And(beside, hn::Ge(u, hn::Neg(u_error))), infinity(), high);
    low = hn::IfThenElse(hn::And(beside, hn::Le(u, u_error)), hn::Neg(infinity()), low);
  }
};

HWY_INLINE Hull empty_hull() {
  return {infinity(), hn::Neg(infinity())};
}

// Disks of given depths and radii between two depths, seen along x or y.
class Disks {
 public:
  HWY_INLINE Disks(VD depth, VD r, double nearest, double farthest)
      : depth_(depth), r_(r), near_(all(nearest)), far_(all(farthest)) {
    near_past_ = reach_past(near_, depth, r);
    far_past_ = reach_past(far_, depth, r);
    const VD none = hn::Zero(DD());
    const MD is_before = hn::Lt(depth, near_), is_beyond = hn::Gt(depth, far_);
    misses_ = hn::Or(hn::And(is_before, hn::Lt(near_past_, none)), hn::And(is_beyond, hn::Lt(far_past_, none)));
    is_endless_ = hn::Eq(r, infinity());
    // A disk that keeps clear of both depths has no chords there, and its tangents touch between them: by more than
    // double precision loses, so that they need not be asked.
    const VD clear = all(-0x1p-30);
    const MD is_clear = hn::And(hn::Lt(near_past_, hn::Mul(clear, depth)), hn::Lt(far_past_, hn::Mul(clear, far_)));
    is_between_ = hn::Not(hn::Or(is_before, is_beyond));
    all_are_clear_ = hn::AllTrue(DD(), hn::And(is_between_, is_clear));
  }

  // geom::slope_range
  HWY_INLINE void slope_range(VD u, VF& low, VF& high) const {
    Hull hull = empty_hull();
    hull.add_slope(is_between_, u, depth_, hn::Zero(DD()));
    add_tangents(u, hull);
    if (!all_are_clear_) {
      add_chord(near_, near_past_, u, hull);
      add_chord(far_, far_past_, u, hull);
    }
    const VD inf = infinity();
    low = rounded_down(hn::IfThenElse(misses_, inf, hn::IfThenElse(is_endless_, hn::Neg(inf), hull.low)));
    high = rounded_up(hn::IfThenElse(misses_, hn::Neg(inf), hn::IfThenElse(is_endless_, inf, hull.high)));
  }

 private:
  HWY_INLINE VD squared_tangent(VD u) const {
    const VD u_square = hn::Mul(u, u), depth_square = hn::Mul(depth_, depth_);
    const VD large = hn::Max(u_square, depth_square), small = hn::Min(u_square, depth_square);
    const VD sum = hn::Add(large, small);
    const VD lost = hn::Sub(small, hn::Sub(sum, large));
    return hn::Add(hn::Sub(sum, hn::Mul(r_, r_)), lost);
  }

  HWY_INLINE void add_tangents(VD u, Hull& hull) const {
    const VD none = hn::Zero(DD());
    const VD squared = squared_tangent(u);
    const VD length = hn::Sqrt(squared), product = hn::Mul(u, depth_);
    const VD q = hn::Add(product, hn::CopySign(hn::Mul(r_, length), product));
    const VD root_q = hn::Div(q, hn::Mul(hn::Sub(depth_, r_), hn::Add(depth_, r_)));
    const VD root_product = hn::Div(hn::Mul(hn::Sub(u, r_), hn::Add(u, r_)), q);
    const MD other_side = hn::Lt(hn::CopySign(all(1.0), product), none);
    const MD exist = hn::Gt(squared, none);
    const MD ahead = hn::Gt(depth_, r_), astride = hn::Gt(depth_, hn::Neg(r_));
    const MD has_low = hn::Or(ahead, hn::And(astride, hn::Gt(u, none)));
    const MD has_high = hn::Or(ahead, hn::And(astride, hn::Lt(u, none)));
    add_tangent(hn::And(exist, has_low), hn::IfThenElse(other_side, root_q, root_product), length, hull);
    add_tangent(hn::And(exist, has_high), hn::IfThenElse(other_side, root_product, root_q), length, hull);
  }

  HWY_INLINE void add_tangent(MD exists, VD slope, VD length, Hull& hull) const {
    if (!all_are_clear_) {
      const VD touch_depth = hn::Div(length, hn::Sqrt(hn::Add(all(1.0), hn::Mul(slope, slope))));
      exists = hn::And(exists, hn::And(hn::Ge(touch_depth, near_), hn::Le(touch_depth, far_)));
    }
    hull.add(exists, slope, hn::Mul(all(16.0 * k_epsilon), hn::Abs(slope)));
  }

  HWY_INLINE void add_chord(VD line, VD past, VD u, Hull& hull) const {
    const MD exists = hn::Ge(past, hn::Zero(DD()));
    const VD half = hn::Sqrt(hn::Mul(past, hn::Add(r_, hn::Abs(hn::Sub(line, depth_)))));
    const VD error = hn::Mul(all(4.0 * k_epsilon), hn::Add(hn::Abs(u), half));
    hull.add_slope(exists, hn::Sub(u, half), line, error);
    hull.add_slope(exists, hn::Add(u, half), line, error);
  }

  VD depth_, r_, near_, far_, near_past_, far_past_;
  MD misses_, is_endless_, is_between_;
  bool all_are_clear_;
};

void find_extents(const BoxPlanes& planes, const SeenBalls& seen, std::uint32_t begin, BoxedBalls& boxed) {
  const DD dd;
  const DF df;
  const auto n = static_cast<std::uint32_t>(hn::Lanes(dd));
  for (std::uint32_t i = begin; i < seen.count; i += n) {
    const auto wide = [&](const std::vector<float>& from) { return hn::PromoteTo(dd, hn::LoadU(df, from.data() + i)); };
    const Disks disks(wide(seen.depth), wide(boxed.box_radius), planes.depths.front(), planes.depths.back());
    VF low, high;
    disks.slope_range(wide(seen.x), low, high);
    hn::StoreU(low, df, boxed.low_x.data() + i);
    hn::StoreU(high, df, boxed.high_x.data() + i);
    disks.slope_range(wide(seen.y), low, high);
    hn::StoreU(low, df, boxed.low_y.data() + i);
    hn::StoreU(high, df, boxed.high_y.data() + i);
  }
}

// --- The intervals that the extents touch: the twin of grid::intervals_touched ---

struct Indices {
  VI first, last;
};

// Looks first where a value is guessed to be.
HWY_INLINE VI first_touched(const std::vector<float>& boundaries, VI guess, V low) {
  return last_passed(boundaries, guess, 0, [&](V boundary) { return hn::Lt(boundary, low); });
}
HWY_INLINE VI last_touched(const std::vector<float>& boundaries, VI guess, V high) {
  return last_passed(boundaries, guess, -1, [&](V boundary) { return hn::Le(boundary, high); });
}

// grid::intervals_touched for low <= high.
HWY_INLINE Indices touched(const BoundaryAxis& axis, V low, V high) {
  return {first_touched(axis.boundaries, guessed(axis, low), low),
          last_touched(axis.boundaries, guessed(axis, high), high)};
}

void find_radii(const SeenBalls& seen, std::uint32_t begin, const GivenBalls& given, std::uint32_t first_light,
                const BallPadding& padding, BoxedBalls& boxed) {
  const D d;
  const DI di;
  const hn::RebindToUnsigned<D> du;
  const auto n = static_cast<std::uint32_t>(hn::Lanes(d));
  for (std::uint32_t i = begin; i < seen.count; i += n) {
    const auto light = hn::Min(hn::LoadU(du, seen.light.data() + i), hn::Set(du, first_light + given.count - 1));
    const VI place = hn::BitCast(di, hn::Sub(hn::Max(light, hn::Set(du, first_light)), hn::Set(du, first_light)));
    const V radius = hn::GatherIndex(d, given.radius, place), reach = hn::GatherIndex(d, given.reach, place);
    hn::StoreU(padded(radius, reach, padding.box), d, boxed.box_radius.data() + i);
    hn::StoreU(padded(radius, reach, padding.ball), d, boxed.ball_radius.data() + i);
  }
}

// Those of the seen balls from `begin` on whose extents touch cells.
void box_balls(const BoxPlanes& planes, const SeenBalls& seen, std::uint32_t begin, BoxedBalls& boxed) {
  const D d;
  const DI di;
  const hn::RebindToUnsigned<D> du;
  const auto n = static_cast<std::uint32_t>(hn::Lanes(d));
  for (std::uint32_t i = begin; i < seen.count; i += n) {
    const auto at = [&](const std::vector<float>& list) { return hn::LoadU(d, list.data() + i); };
    const V x = at(seen.x), y = at(seen.y), depth = at(seen.depth), r = at(boxed.box_radius);
    const V low_x = at(boxed.low_x), high_x = at(boxed.high_x), low_y = at(boxed.low_y), high_y = at(boxed.high_y);
    const Indices columns = touched(planes.columns, low_x, high_x);
    const Indices rows = touched(planes.rows, hn::Neg(high_y), hn::Neg(low_y));
    const auto guess = [&](const std::vector<std::int32_t>& list) { return hn::LoadU(di, list.data() + i); };
    const Indices slices{first_touched(planes.depths, guess(seen.first_slice), hn::Sub(depth, r)),
                         last_touched(planes.depths, guess(seen.last_slice), hn::Add(depth, r))};
    const auto is_some = [&](const Indices& some) { return hn::RebindMask(d, hn::Not(hn::Lt(some.last, some.first))); };
    const auto has_extents = hn::And(hn::Le(low_x, high_x), hn::Le(low_y, high_y));
    const auto has_cells = hn::And(is_some(columns), hn::And(is_some(rows), is_some(slices)));
    const auto wanted = hn::And(hn::FirstN(d, seen.count - i), hn::And(has_extents, has_cells));
    const auto keep = [&](V value, std::vector<float>& to) {
      hn::StoreU(hn::Compress(value, wanted), d, to.data() + boxed.count);
    };
    keep(x, boxed.x);
    keep(y, boxed.y);
    keep(depth, boxed.depth);
    keep(at(boxed.ball_radius), boxed.radius);
    hn::StoreU(hn::Compress(hn::LoadU(du, seen.light.data() + i), hn::RebindMask(du, wanted)), du,
               boxed.light.data() + boxed.count);
    const auto keep_indices = [&](const Indices& some, std::vector<std::int32_t>& first,
                                  std::vector<std::int32_t>& last) {
      const auto wanted_int = hn::RebindMask(di, wanted);
      hn::StoreU(hn::Compress(some.first, wanted_int), di, first.data() + boxed.count);
      hn::StoreU(hn::Compress(some.last, wanted_int), di, last.data() + boxed.count);
    };
    keep_indices(columns, boxed.first_column, boxed.last_column);
    keep_indices(rows, boxed.first_row, boxed.last_row);
    keep_indices(slices, boxed.first_slice, boxed.last_slice);
    boxed.count += static_cast<std::uint32_t>(hn::CountTrue(d, wanted));
  }
}

void find_boxes(const BoxPlanes& planes, const SeenBalls& seen, std::uint32_t begin, const GivenBalls& given,
                std::uint32_t first_light, const BallPadding& padding, BoxedBalls& boxed) {
  find_radii(seen, begin, given, first_light, padding, boxed);
  find_extents(planes, seen, begin, boxed);
  box_balls(planes, seen, begin, boxed);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(find_boxes);

BoxPlanes::BoxPlanes(const grid::ScreenGrid& grid) : depths(grid.slices.boundaries) {
  // An edge tile may be clipped: the first one tells the width.
  const std::vector<float>&x = grid.tiles.x, &y = grid.tiles.y;
  columns = {x, x[0], 1.0f / (x[1] - x[0])};
  rows = {y, -y[0], 1.0f / (y[0] - y[1])};
  for (float& slope : rows.boundaries) slope = -slope;
}

void BoxedBalls::reserve(std::uint32_t most) {
  const std::size_t size = most + k_most_lanes;
  for (std::vector<float>* list :
       {&x, &y, &depth, &radius, &low_x, &high_x, &low_y, &high_y, &box_radius, &ball_radius})
    if (list->size() < size) list->resize(size);
  for (std::vector<std::int32_t>* list :
       {&first_column, &last_column, &first_row, &last_row, &first_slice, &last_slice})
    if (list->size() < size) list->resize(size);
  if (light.size() < size) light.resize(size);
}

std::size_t BoxedBalls::capacity_bytes() const {
  return 17 * sizeof(float) * light.capacity();
}

void find_cell_boxes(const BoxPlanes& planes, const SeenBalls& seen, std::uint32_t begin, const GivenBalls& given,
                     std::uint32_t first_light, const BallPadding& padding, BoxedBalls& boxed) {
  HWY_DYNAMIC_DISPATCH(find_boxes)(planes, seen, begin, given, first_light, padding, boxed);
}

}  // namespace clusterbench::assign
#endif
