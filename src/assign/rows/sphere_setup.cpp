#include "assign/rows/sphere_setup.h"

#define HWY_TARGET_INCLUDE "assign/rows/sphere_setup.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target

#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign::HWY_NAMESPACE {
namespace {

// Both tangents from the eye to a circle.
struct Touches {
  V low, high;
};

// The inverse depths ahead at which they touch a circle around (across, ahead); k_at_eye if there is none.
// `ahead_square`: ahead² - radius².
HWY_INLINE Touches touches_of(V across, V ahead, V radius, V ahead_square) {
  const V zero = Zero(D()), at_eye = all(SphereSetup::k_at_eye), across_square = across * across;
  const V square = across_square + ahead_square;
  const V sum = ahead + radius * Abs(across) / root(square);
  const M exist = And(square > zero, sum > zero);
  const V outer = IfThenElse(And(exist, ahead_square > zero), sum / ahead_square, at_eye);
  const V from_eye = across_square + ahead * ahead;
  const V inner = IfThenElse(exist, from_eye / (square * sum), at_eye);
  const M is_positive = across >= zero;
  return {IfThenElse(is_positive, inner, outer), IfThenElse(is_positive, outer, inner)};
}

// The radius, or slightly more than the distance if the two are nearly equal. So the sign of the difference of their
// squares is certain, and its size up to a quarter.
HWY_INLINE V lifted(V radius, V distance_square) {
  const V gap = distance_square - radius * radius;
  const M is_near = Abs(gap) < all(0x1p-18f) * distance_square;
  if (AllFalse(D(), is_near)) return radius;
  return IfThenElse(is_near, Max(radius, root(distance_square) * all(1.0f + 0x1p-21f)), radius);
}

void setup_of(const VisibleBalls& visible, std::uint32_t count, SphereSetup& out) {
  const V zero = Zero(D());
  for (std::size_t i = 0; i < count; i += Lanes(D())) {
    const auto load = [&](const auto& from) { return LoadU(D(), reinterpret_cast<const float*>(from.data() + i)); };
    // Balls that are everywhere are centred at the eye, where no product of theirs is infinity minus infinity.
    const V given = load(visible.radius);
    const M is_bounded = given < infinity();
    const V x = IfThenElseZero(is_bounded, load(visible.x)), y = IfThenElseZero(is_bounded, load(visible.y));
    const V depth = IfThenElseZero(is_bounded, load(visible.depth));
    const V x_square = x * x, y_square = y * y, depth_square = depth * depth;
    const V from_eye = x_square + y_square + depth_square;
    const V nearer = Min(x_square, y_square), farther = Max(x_square, y_square);
    V radius = lifted(given, nearer + depth_square);
    radius = lifted(radius, farther + depth_square);
    radius = lifted(radius, from_eye);
    const M is_lifted = radius > given;
    const V slack = load(visible.slack) + IfThenElseZero(is_lifted, radius - given);
    const V ahead_square = (depth - radius) * (depth + radius);
    const V upright = y_square + ahead_square, square = x_square + upright;
    const M is_outside = square > zero;
    // A touch point is as far from the eye as a tangent is long, and not deeper than the ball. The chord's error moves
    // it by up to |x| depth / upright of itself, and upright's, 3 e c² at a distance c from the eye, by that over
    // upright of its distance: the chord's part is at most sqrt(7 e radius), upright's 0.57 of that and also 3/16 of
    // the radius: see Certainty.
    const V tangent = root(square), reach = root(from_eye);
    const V deepest = Min(Max(zero, depth + radius), tangent);
    const V of_chord = Abs(x) * deepest * all(1.0f / 7.0f);
    const V of_upright = all(0x1p-11f) * from_eye * (tangent / root(reach * radius));
    const V of_small = from_eye * (all(0x1p-20f) * reach / radius);
    const V least = Max(of_chord, Max(of_upright, of_small));
    const M is_precise = Abs(upright) >= least;
    const V inverse_upright = IfThenElse(is_outside, IfThenElseZero(is_precise, all(1.0f) / upright), infinity());
    const V lean = IfThenElseZero(is_outside, x / tangent);
    StoreInterleaved4(x, y, depth, radius, D(), out.sphere.data() + 4 * i);
    StoreInterleaved4(slack, load(visible.light), lean, inverse_upright, D(), out.touch.data() + 4 * i);
    const Touches sideways = touches_of(x, depth, radius, ahead_square);
    const Touches upwards = touches_of(y, depth, radius, ahead_square);
    StoreInterleaved4(sideways.low, sideways.high, upwards.low, upwards.high, D(), out.extremes.data() + 4 * i);
  }
}

}  // namespace
}  // namespace clusterbench::assign::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(setup_of);

void set_up_spheres(const VisibleBalls& visible, std::uint32_t count, SphereSetup& out) {
  grow_to(4 * visible.x.size(), out.sphere, out.touch, out.extremes);
  HWY_DYNAMIC_DISPATCH(setup_of)(visible, count, out);
}

}  // namespace clusterbench::assign
#endif
