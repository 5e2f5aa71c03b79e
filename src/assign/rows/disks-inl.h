// The slopes of disks in double precision, for files that are compiled once per target: the vector form of
// geom/projection/disk_tangents.cpp.

#if defined(CLUSTERBENCH_DISKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLUSTERBENCH_DISKS_INL_H
#undef CLUSTERBENCH_DISKS_INL_H
#else
#define CLUSTERBENCH_DISKS_INL_H
#endif

#include <limits>

#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign::HWY_NAMESPACE {

constexpr double k_epsilon = std::numeric_limits<double>::epsilon();

HWY_INLINE VD infinite() {
  return all(std::numeric_limits<double>::infinity());
}

HWY_INLINE VD in_single(VD value) {
  return PromoteTo(DD(), DemoteTo(DF(), value));
}

// A vector of floats in parts that have as many lanes as a vector of doubles.
class Parts {
 public:
#if HWY_TARGET == HWY_SCALAR
  static constexpr std::size_t k_count = 1;
  explicit Parts(V value) : parts_{value} {}
  V whole() const {
    return parts_[0];
  }
#else
  static constexpr std::size_t k_count = 2;
  HWY_INLINE explicit Parts(V value) : parts_{LowerHalf(DF(), value), UpperHalf(DF(), value)} {}
  HWY_INLINE V whole() const {
    return Combine(D(), parts_[1], parts_[0]);
  }
#endif
  Parts() = default;
  HWY_INLINE VD wide(std::size_t part) const {
    return PromoteTo(DD(), parts_[part]);
  }
  HWY_INLINE void set(std::size_t part, VD value) {
    parts_[part] = DemoteTo(DF(), value);
  }

 private:
  VF parts_[k_count];
};

// The nearest float at or below a value.
HWY_INLINE VD rounded_down(VD value) {
  const DF df;
  const hn::RebindToUnsigned<DF> du;
  const VF nearest = DemoteTo(df, value);
  const auto bits = BitCast(du, nearest);
  const auto is_negative = TestBit(bits, Set(du, 0x80000000));
  const auto ulp = Set(du, 1);
  const VF below = BitCast(df, IfThenElse(is_negative, bits + ulp, bits - ulp));
  const VD wide = PromoteTo(DD(), nearest);
  return IfThenElse(wide > value, PromoteTo(DD(), below), wide);
}

HWY_INLINE VD rounded_up(VD value) {
  return Neg(rounded_down(Neg(value)));
}

HWY_INLINE VD reach_past(VD line, VD depth, VD r) {
  const VD small = Min(line, depth), large = Max(line, depth);
  return IfThenElse(small >= all(0.5) * large, r - (large - small), r - large + small);
}

struct Hull {
  VD low, high;

  HWY_INLINE void add(MD where, VD value, VD error) {
    low = Min(low, IfThenElse(where, value - error, infinite()));
    high = Max(high, IfThenElse(where, value + error, Neg(infinite())));
  }
  // At depth 0 the slope is infinite, on both sides where the side is not certain.
  HWY_INLINE void add_slope(MD where, VD u, VD depth, VD u_error) {
    const MD ahead = depth > Zero(DD());
    const VD slope = u / depth;
    add(And(where, ahead), slope, u_error / depth + all(2.0 * k_epsilon) * Abs(slope));
    if (AllTrue(DD(), ahead)) return;
    const MD beside = AndNot(ahead, where);
    high = IfThenElse(And(beside, u >= Neg(u_error)), infinite(), high);
    low = IfThenElse(And(beside, u <= u_error), Neg(infinite()), low);
  }
};

HWY_INLINE Hull empty_hull() {
  return {infinite(), Neg(infinite())};
}

// Disks of given depths and radii between two depths (the farther one may be infinite), seen along x or y.
class Disks {
 public:
  HWY_INLINE Disks(VD depth, VD r, double nearest, double farthest)
      : depth_(depth), r_(r), near_(all(nearest)), far_(all(farthest)) {
    near_past_ = reach_past(near_, depth, r);
    far_past_ = reach_past(far_, depth, r);
    const VD none = Zero(DD());
    const MD is_before = depth<near_, is_beyond = depth> far_;
    misses_ = Or(And(is_before, near_past_ < none), And(is_beyond, far_past_ < none));
    is_endless_ = r == infinite();
    // A disk that keeps clear of both depths has no chords there, and its tangents touch between them. The clearance is
    // larger than the error of double precision, so the tangents need no test.
    const VD clear = all(-0x1p-30);
    const MD is_clear = And(near_past_ < clear * depth, far_past_ <= clear * far_);
    is_between_ = Not(Or(is_before, is_beyond));
    all_are_clear_ = AllTrue(DD(), And(is_between_, is_clear));
  }

  // geom::slope_range
  HWY_INLINE Hull slope_range(VD u) const {
    Hull hull = empty_hull();
    hull.add_slope(is_between_, u, depth_, Zero(DD()));
    add_tangents(u, hull);
    if (!all_are_clear_) {
      add_chord(near_, near_past_, u, hull);
      add_chord(far_, far_past_, u, hull);
    }
    return rounded(hull);
  }

  // geom::offset_range
  HWY_INLINE Hull offset_range(VD u) const {
    const VD line = Min(Max(depth_, near_), far_);
    const VD past = IfThenElse(depth_ < near_, near_past_, far_past_);
    const VD half = IfThenElse(is_between_, r_, half_chord(line, past)), error = chord_error(u, half);
    return rounded({u - half - error, u + half + error});
  }

 private:
  HWY_INLINE Hull rounded(const Hull& hull) const {
    const VD inf = infinite();
    return {rounded_down(IfThenElse(misses_, inf, IfThenElse(is_endless_, Neg(inf), hull.low))),
            rounded_up(IfThenElse(misses_, Neg(inf), IfThenElse(is_endless_, inf, hull.high)))};
  }

  // NaN if the disk does not reach past the line.
  HWY_INLINE VD half_chord(VD line, VD past) const { return Sqrt(past * (r_ + Abs(line - depth_))); }
  HWY_INLINE VD chord_error(VD u, VD half) const { return all(4.0 * k_epsilon) * (Abs(u) + half); }

  HWY_INLINE VD squared_tangent(VD u) const {
    const VD u_square = u * u, depth_square = depth_ * depth_;
    const VD large = Max(u_square, depth_square), small = Min(u_square, depth_square);
    const VD sum = large + small;
    const VD lost = small - (sum - large);
    return sum - r_ * r_ + lost;
  }

  HWY_INLINE void add_tangents(VD u, Hull& hull) const {
    const VD none = Zero(DD());
    const VD squared = squared_tangent(u);
    const VD length = Sqrt(squared), product = u * depth_;
    const VD q = product + CopySign(r_ * length, product);
    const VD root_q = q / ((depth_ - r_) * (depth_ + r_));
    const VD root_product = (u - r_) * (u + r_) / q;
    const MD other_side = CopySign(all(1.0), product) < none;
    const MD exist = And(squared > none, r_ > none);
    const MD ahead = depth_ > r_, astride = depth_ > Neg(r_);
    const MD has_low = Or(ahead, And(astride, u > none));
    const MD has_high = Or(ahead, And(astride, u < none));
    add_tangent(And(exist, has_low), IfThenElse(other_side, root_q, root_product), length, hull);
    add_tangent(And(exist, has_high), IfThenElse(other_side, root_product, root_q), length, hull);
  }

  HWY_INLINE void add_tangent(MD exists, VD slope, VD length, Hull& hull) const {
    if (!all_are_clear_) {
      const VD touch_depth = length / Sqrt(all(1.0) + slope * slope);
      exists = And(exists, And(touch_depth >= near_, touch_depth <= far_));
    }
    hull.add(exists, slope, all(16.0 * k_epsilon) * Abs(slope));
  }

  HWY_INLINE void add_chord(VD line, VD past, VD u, Hull& hull) const {
    const MD exists = past >= Zero(DD());
    const VD half = half_chord(line, past), error = chord_error(u, half);
    hull.add_slope(exists, u - half, line, error);
    hull.add_slope(exists, u + half, line, error);
  }

  VD depth_, r_, near_, far_, near_past_, far_past_;
  MD misses_, is_endless_, is_between_;
  bool all_are_clear_;
};

}  // namespace clusterbench::assign::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
