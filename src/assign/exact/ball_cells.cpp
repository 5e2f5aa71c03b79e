#include "assign/exact/ball_cells.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assign/exact/ball_cells.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_NATIVE_FMA

using DD = hn::ScalableTag<double>;
using VD = hn::Vec<DD>;
using MD = hn::Mask<DD>;
using DF = hn::Rebind<float, DD>;  // as many lanes
using DI = hn::Rebind<std::int32_t, DD>;
using VI = hn::Vec<DI>;
static_assert(MaxLanes(DD()) <= 8);  // bits of a byte

HWY_INLINE VD every(double value) {
  return Set(DD(), value);
}

// geom::Bounded, one per lane; but what errors lose when they are added and multiplied, fewer than a hundred times, is
// made up for where they are used, by rounded_up().
struct Bound {
  VD value, error;
};

HWY_INLINE Bound exactly(VD value) {
  return {value, Zero(DD())};
}
HWY_INLINE VD rounded_up(VD error) {
  const VD larger = error * every(1.0 + 0x1p-44) + every(0x1p-1000);
  return IfThenElseZero(error > Zero(DD()), larger);
}
HWY_INLINE Bound operator+(const Bound& a, const Bound& b) {
  const VD sum = a.value + b.value, from_b = sum - a.value;
  const VD lost = a.value - (sum - from_b) + (b.value - from_b);
  return {sum, a.error + b.error + Abs(lost)};
}
HWY_INLINE Bound operator-(const Bound& a, const Bound& b) {
  return a + Bound{Neg(b.value), b.error};
}
// What a product loses is what a fused multiply and subtract finds, if it is not below what a double can hold; neither
// are the products of errors nothing where they are.
HWY_INLINE Bound operator*(const Bound& a, const Bound& b) {
  const VD zero = Zero(DD());
  const VD product = a.value * b.value, lost = Abs(MulSub(a.value, b.value, product));
  const VD size_of_a = Abs(a.value) + a.error, size_of_b = Abs(b.value) + b.error;
  const MD is_something = And(size_of_a > zero, size_of_b > zero);
  const MD is_rough = Or(Abs(product) < every(0x1p-900), a.error + b.error > zero);
  const VD rounding = Max(lost, IfThenElseZero(And(is_something, is_rough), every(0x1p-1000)));
  const VD of_a = a.error * size_of_b, of_b = Abs(a.value) * b.error;
  return {product, of_a + of_b + rounding};
}

// How far a centre is outside of low <= at <= high, and which side's slope makes it change with depth (0: neither's).
struct Gap {
  Bound size;
  VD slope;
};
HWY_INLINE Gap gap_between(const Bound& low, const Bound& at, const Bound& high, VD slope_low, VD slope_high) {
  const VD zero = Zero(DD());
  const Bound below = low - at, above = at - high;
  const MD is_below = below.value > above.value;
  const VD value = Max(below.value, above.value), error = rounded_up(Max(below.error, above.error));
  const MD is_outside = value > zero;
  const VD most = Max(rounded_up(value + error), zero);
  const VD inside = IfThenElseZero(error > zero, most);
  const VD slope = IfThenElseZero(is_outside, IfThenElse(is_below, slope_low, Neg(slope_high)));
  return {{Max(value, zero), IfThenElse(is_outside, error, inside)}, slope};
}

// Half the slope, along depth, of a gap's square.
HWY_INLINE Bound half_slope(const Gap& gap, VD slope_low, VD slope_high) {
  const Bound product = exactly(gap.slope) * gap.size;
  const VD unsure = (Abs(slope_low) + Abs(slope_high)) * gap.size.error;
  return {product.value, rounded_up(product.error + unsure)};
}

// A vector of pairs, from place `at` on.
class Pairs {
 public:
  Pairs(const view::LightArrays& lights, const RowPlanes& planes, const BallCells& cells, std::size_t at)
      : orthographic_(planes.orthographic) {
    const auto load = [&](const std::vector<std::int32_t>& from) { return LoadU(DI(), from.data() + at); };
    const VI column = load(cells.column), row = load(cells.row), slice = load(cells.slice);
    const auto plane_at = [&](const std::vector<float>& from, VI place) {
      return PromoteTo(DD(), GatherIndex(DF(), from.data(), place));
    };
    const VI one = Set(DI(), 1);
    x0_ = plane_at(planes.side, column);
    x1_ = plane_at(planes.side, column + one);
    y0_ = plane_at(planes.slope, row + one);
    y1_ = plane_at(planes.slope, row);
    depth0_ = plane_at(planes.depth, slice);
    depth1_ = plane_at(planes.depth, slice + one);

    constexpr std::size_t k_stride = sizeof(scene::WorldLight) / sizeof(double);
    static_assert(sizeof(scene::WorldLight) % sizeof(double) == 0);
    const auto place = PromoteTo(hn::Rebind<std::int64_t, DD>(), load(cells.light)) *
                       Set(hn::Rebind<std::int64_t, DD>(), std::int64_t{k_stride});
    const auto of_light = [&](const double& first) { return exactly(GatherIndex(DD(), &first, place)); };
    const scene::WorldLight& first = lights.source.front();
    const Bound range = of_light(first.range_m);
    squared_range_ = range * range;
    const view::Space& space = lights.space;
    const Bound from_origin[3] = {of_light(first.position.x) - exactly(every(space.origin.x)),
                                  of_light(first.position.y) - exactly(every(space.origin.y)),
                                  of_light(first.position.z) - exactly(every(space.origin.z))};
    x_ = turned(space.rotation, 0, from_origin);
    y_ = turned(space.rotation, 1, from_origin);
    const Bound z = turned(space.rotation, 2, from_origin);
    depth_ = {Neg(z.value), z.error};
  }

  // As in geom/ball.cpp.
  HWY_INLINE void look(MD& touches, MD& misses) const {
    const VD zero = Zero(DD()), at = nearest_depth();
    const Bound depth = exactly(at), along = depth - depth_;
    const Gap x = gap_between(plane(x0_, depth), x_, plane(x1_, depth), x0_, x1_);
    const Gap y = gap_between(plane(y0_, depth), y_, plane(y1_, depth), y0_, y1_);
    const Bound excess = x.size * x.size + y.size * y.size + along * along - squared_range_;
    const VD error = rounded_up(excess.error);
    touches = excess.value <= Neg(error);
    VD undershoot = zero;
    if (!orthographic_ && !AllTrue(DD(), touches)) {
      const Bound slope = half_slope(x, x0_, x1_) + half_slope(y, y0_, y1_) + along;
      const VD slope_error = rounded_up(slope.error);
      const VD falls = IfThenElseZero(at < depth1_, slope_error - slope.value);
      const VD rises = IfThenElseZero(at > depth0_, slope_error + slope.value);
      const VD steepness = rounded_up(Max(zero, Max(falls, rises)));
      undershoot = rounded_up(steepness * steepness);
      // A square too small for a double.
      undershoot = IfThenElse(steepness > zero, Max(undershoot, every(0x1p-1000)), zero);
    }
    misses = excess.value - undershoot > error;
  }

 private:
  // A coordinate of a vector in a space. What is multiplied by 0 or 1, as where cameras stand straight, costs nothing.
  static HWY_INLINE Bound turned(const Mat3d& rotation, int row, const Bound (&vector)[3]) {
    Bound sum = exactly(Zero(DD()));
    bool is_empty = true;
    for (int column = 0; column < 3; ++column) {
      const double factor = rotation[column][row];
      if (factor == 0.0) continue;
      const Bound part = factor == 1.0 ? vector[column] : exactly(every(factor)) * vector[column];
      sum = is_empty ? part : sum + part;
      is_empty = false;
    }
    return sum;
  }

  HWY_INLINE Bound plane(VD slope, const Bound& depth) const {
    return orthographic_ ? exactly(slope) : exactly(slope) * depth;
  }
  HWY_INLINE VD slope_at(VD at, VD place, VD low, VD high) const {
    return IfThenElse(place < low * at, low, IfThenElseZero(place > high * at, high));
  }
  HWY_INLINE VD clamped(VD depth) const { return Min(Max(depth, depth0_), depth1_); }

  HWY_INLINE VD nearest_depth() const {
    VD at = clamped(depth_.value);
    if (orthographic_) return at;
    constexpr int k_steps = 3;
    for (int i = 0; i < k_steps; ++i) {
      const VD slope_x = slope_at(at, x_.value, x0_, x1_), slope_y = slope_at(at, y_.value, y0_, y1_);
      const VD along = depth_.value + (slope_x * x_.value + slope_y * y_.value);
      const VD square = every(1.0) + (slope_x * slope_x + slope_y * slope_y);
      const VD next = clamped(along / square);
      if (AllTrue(DD(), next == at)) break;
      at = next;
    }
    return at;
  }

  bool orthographic_;
  VD x0_, x1_, y0_, y1_, depth0_, depth1_;
  Bound x_, y_, depth_, squared_range_;
};

void look(const view::LightArrays& lights, const RowPlanes& planes, BallCells& cells) {
  const std::size_t lanes = Lanes(DD());
  for (std::size_t first = 0; first < cells.count; first += lanes) {
    MD touches, misses;
    Pairs(lights, planes, cells, first).look(touches, misses);
    std::uint8_t yes[8] = {}, no[8] = {};
    StoreMaskBits(DD(), touches, yes);
    StoreMaskBits(DD(), misses, no);
    for (std::size_t lane = 0; lane < lanes; ++lane)
      cells.touch[first + lane] = (yes[0] >> lane & 1) != 0  ? Touch::yes
                                  : (no[0] >> lane & 1) != 0 ? Touch::no
                                                             : Touch::open;
  }
}

#else

void look(const view::LightArrays&, const RowPlanes&, BallCells& cells) {
  std::fill_n(cells.touch.begin(), cells.count, Touch::open);
}

#endif

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(look);

void BallCells::reserve(std::size_t most) {
  const std::size_t size = most + k_most_lanes;
  if (touch.size() >= size) return;
  for (std::vector<std::int32_t>* list : {&light, &slice, &row, &column}) list->resize(size);
  touch.resize(size);
}

void look_at_balls(const view::LightArrays& lights, const RowPlanes& planes, BallCells& cells) {
  if (cells.count == 0) return;
  // What a whole vector reads beyond the end must be places that exist.
  for (std::vector<std::int32_t>* list : {&cells.light, &cells.slice, &cells.row, &cells.column})
    std::fill_n(list->begin() + cells.count, k_most_lanes, 0);
  HWY_DYNAMIC_DISPATCH(look)(lights, planes, cells);
}

}  // namespace clusterbench::assign
#endif
