#include "assign/simd/ball_shapes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assign/simd/ball_shapes.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target
#include <hwy/highway.h>

#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {
namespace {

// Both tangents from the eye to a circle.
struct Touches {
  V low, high;
};

// The inverse depths ahead at which they touch a circle around (across, ahead), k_at_eye where they do so at none.
// `ahead_square`: ahead² - radius².
HWY_INLINE Touches touches_of(V across, V ahead, V radius, V ahead_square) {
  const V zero = hn::Zero(D()), at_eye = all(BallShapes::k_at_eye), across_square = hn::Mul(across, across);
  const V square = hn::Add(across_square, ahead_square);
  const V sum = hn::Add(ahead, hn::Div(hn::Mul(radius, hn::Abs(across)), root(square)));
  const M exist = hn::And(hn::Gt(square, zero), hn::Gt(sum, zero));
  const V outer = hn::IfThenElse(hn::And(exist, hn::Gt(ahead_square, zero)), hn::Div(sum, ahead_square), at_eye);
  const V from_eye = hn::Add(across_square, hn::Mul(ahead, ahead));
  const V inner = hn::IfThenElse(exist, hn::Div(from_eye, hn::Mul(square, sum)), at_eye);
  const M is_positive = hn::Ge(across, zero);
  return {hn::IfThenElse(is_positive, inner, outer), hn::IfThenElse(is_positive, outer, inner)};
}

// The radius, or a little more than a distance if it is nearly that. So the sign of the difference of their squares is
// certain, and its size but for a tenth.
HWY_INLINE V lifted(V radius, V distance_square) {
  const V gap = hn::Sub(distance_square, hn::Mul(radius, radius));
  const M is_near = hn::Lt(hn::Abs(gap), hn::Mul(all(0x1p-18f), distance_square));
  if (hn::AllFalse(D(), is_near)) return radius;
  return hn::IfThenElse(is_near, hn::Max(radius, hn::Mul(root(distance_square), all(1.0f + 0x1p-21f))), radius);
}

void shapes_of(const SeenBalls& seen, std::uint32_t count, BallShapes& out) {
  const D d;
  const V zero = hn::Zero(d), one = all(1.0f);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto load = [&](const auto& from) { return hn::LoadU(d, reinterpret_cast<const float*>(from.data() + i)); };
    // Balls that are everywhere are around the eye, where no product of theirs is infinite minus infinite.
    const V given = load(seen.radius);
    const M is_bounded = hn::Lt(given, infinity());
    const V x = hn::IfThenElseZero(is_bounded, load(seen.x)), y = hn::IfThenElseZero(is_bounded, load(seen.y));
    const V depth = hn::IfThenElseZero(is_bounded, load(seen.depth));
    const V x_square = hn::Mul(x, x), y_square = hn::Mul(y, y), depth_square = hn::Mul(depth, depth);
    const V from_eye = hn::Add(hn::Add(x_square, y_square), depth_square);
    const V nearer = hn::Min(x_square, y_square), farther = hn::Max(x_square, y_square);
    V radius = lifted(given, hn::Add(nearer, depth_square));
    radius = lifted(radius, hn::Add(farther, depth_square));
    radius = lifted(radius, from_eye);
    const M is_lifted = hn::Gt(radius, given);
    const V slack = hn::Add(load(seen.slack), hn::IfThenElseZero(is_lifted, hn::Sub(radius, given)));
    const V ahead_square = hn::Mul(hn::Sub(depth, radius), hn::Add(depth, radius));
    const V upright = hn::Add(y_square, ahead_square), square = hn::Add(x_square, upright);
    const M is_outside = hn::Gt(square, zero);
    // A touch point is as far from the eye as a tangent is long, and not deeper than the ball. The chord's error moves
    // it by up to |x| depth / upright of itself, and upright's, 3 e c², by that over upright of how far it is away:
    // that is less than what Certainty asks for, sqrt(7 e radius), and also than 3/16 of the radius.
    const V tangent = root(square), reach = root(from_eye);
    const V deepest = hn::Min(hn::Max(zero, hn::Add(depth, radius)), tangent);
    const V of_chord = hn::Mul(hn::Mul(hn::Abs(x), deepest), all(1.0f / 7.0f));
    const V of_upright = hn::Mul(hn::Mul(all(0x1p-11f), from_eye), hn::Div(tangent, root(hn::Mul(reach, radius))));
    const V of_small = hn::Mul(from_eye, hn::Div(hn::Mul(all(0x1p-20f), reach), radius));
    const V least = hn::Max(of_chord, hn::Max(of_upright, of_small));
    const M is_precise = hn::Ge(hn::Abs(upright), least);
    const V inverse_upright =
        hn::IfThenElse(is_outside, hn::IfThenElseZero(is_precise, hn::Div(one, upright)), infinity());
    const V lean = hn::IfThenElseZero(is_outside, hn::Div(x, tangent));
    hn::StoreInterleaved4(x, y, depth, radius, d, out.sphere.data() + 4 * i);
    hn::StoreInterleaved4(slack, load(seen.light), lean, inverse_upright, d, out.touch.data() + 4 * i);
    const Touches sideways = touches_of(x, depth, radius, ahead_square);
    const Touches upwards = touches_of(y, depth, radius, ahead_square);
    hn::StoreInterleaved4(sideways.low, sideways.high, upwards.low, upwards.high, d, out.extremes.data() + 4 * i);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(shapes_of);

void shape_balls(const SeenBalls& seen, std::uint32_t count, BallShapes& out) {
  const std::size_t size = 4 * seen.x.size();
  for (AlignedVector<float>* list : {&out.sphere, &out.touch, &out.extremes})
    if (list->size() < size) list->resize(size);
  HWY_DYNAMIC_DISPATCH(shapes_of)(seen, count, out);
}

}  // namespace clusterbench::assign
#endif
