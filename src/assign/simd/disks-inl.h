// The slopes of disks in double precision, for files that are compiled once per target: the twin of geom/tangents.cpp.
// Included after hwy/highway.h; defines its names anew for each target.

#if defined(CLUSTERBENCH_DISKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLUSTERBENCH_DISKS_INL_H
#undef CLUSTERBENCH_DISKS_INL_H
#else
#define CLUSTERBENCH_DISKS_INL_H
#endif

#include <limits>

#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {

using DD = hn::ScalableTag<double>;
using DF = hn::Rebind<float, DD>;  // as many lanes
using VD = hn::Vec<DD>;
using VF = hn::Vec<DF>;
using MD = hn::Mask<DD>;

constexpr double k_epsilon = std::numeric_limits<double>::epsilon();

HWY_INLINE VD all(double value) {
  return hn::Set(DD(), value);
}
HWY_INLINE VD infinite() {
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
    low = hn::Min(low, hn::IfThenElse(where, hn::Sub(value, error), infinite()));
    high = hn::Max(high, hn::IfThenElse(where, hn::Add(value, error), hn::Neg(infinite())));
  }
  // At depth 0 the slope is infinite, on both sides where the side is not certain.
  HWY_INLINE void add_slope(MD where, VD u, VD depth, VD u_error) {
    const MD ahead = hn::Gt(depth, hn::Zero(DD()));
    const VD slope = hn::Div(u, depth);
    add(hn::And(where, ahead), slope, hn::Add(hn::Div(u_error, depth), hn::Mul(all(2.0 * k_epsilon), hn::Abs(slope))));
    if (hn::AllTrue(DD(), ahead)) return;
    const MD beside = hn::AndNot(ahead, where);
    high = hn::IfThenElse(hn::And(beside, hn::Ge(u, hn::Neg(u_error))), infinite(), high);
    low = hn::IfThenElse(hn::And(beside, hn::Le(u, u_error)), hn::Neg(infinite()), low);
  }
};

HWY_INLINE Hull empty_hull() {
  return {infinite(), hn::Neg(infinite())};
}

// Disks of given depths and radii between two depths (the farther one may be infinite), seen along x or y.
class Disks {
 public:
  HWY_INLINE Disks(VD depth, VD r, double nearest, double farthest)
      : depth_(depth), r_(r), near_(all(nearest)), far_(all(farthest)) {
    near_past_ = reach_past(near_, depth, r);
    far_past_ = reach_past(far_, depth, r);
    const VD none = hn::Zero(DD());
    const MD is_before = hn::Lt(depth, near_), is_beyond = hn::Gt(depth, far_);
    misses_ = hn::Or(hn::And(is_before, hn::Lt(near_past_, none)), hn::And(is_beyond, hn::Lt(far_past_, none)));
    is_endless_ = hn::Eq(r, infinite());
    // A disk that keeps clear of both depths has no chords there, and its tangents touch between them: by more than
    // double precision loses, so that they need not be asked.
    const VD clear = all(-0x1p-30);
    const MD is_clear = hn::And(hn::Lt(near_past_, hn::Mul(clear, depth)), hn::Le(far_past_, hn::Mul(clear, far_)));
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
    round(hull.low, hull.high, low, high);
  }

  // geom::offset_range
  HWY_INLINE void offset_range(VD u, VF& low, VF& high) const {
    const VD line = hn::Min(hn::Max(depth_, near_), far_);
    const VD past = hn::IfThenElse(hn::Lt(depth_, near_), near_past_, far_past_);
    const VD chord = hn::Sqrt(hn::Mul(past, hn::Add(r_, hn::Abs(hn::Sub(line, depth_)))));
    const VD half = hn::IfThenElse(is_between_, r_, chord);
    const VD error = hn::Mul(all(4.0 * k_epsilon), hn::Add(hn::Abs(u), half));
    round(hn::Sub(hn::Sub(u, half), error), hn::Add(hn::Add(u, half), error), low, high);
  }

 private:
  HWY_INLINE void round(VD from, VD to, VF& low, VF& high) const {
    const VD inf = infinite();
    low = rounded_down(hn::IfThenElse(misses_, inf, hn::IfThenElse(is_endless_, hn::Neg(inf), from)));
    high = rounded_up(hn::IfThenElse(misses_, hn::Neg(inf), hn::IfThenElse(is_endless_, inf, to)));
  }

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
    const MD exist = hn::And(hn::Gt(squared, none), hn::Gt(r_, none));
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

}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
HWY_AFTER_NAMESPACE();

#endif
