// Where values are among the boundaries of an axis, for files that are compiled once per target: a guess that the
// boundaries themselves settle.

#if defined(CLUSTERBENCH_BOUNDARIES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLUSTERBENCH_BOUNDARIES_INL_H
#undef CLUSTERBENCH_BOUNDARIES_INL_H
#else
#define CLUSTERBENCH_BOUNDARIES_INL_H
#endif

#include "assign/simd/boundary_axis.h"
#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign::HWY_NAMESPACE {

// passes(boundary) holds up to some boundary and for none beyond. Finds the last of boundaries `least` .. that passes,
// or `least` (0 or -1), whether it passes or not; with -1 the last boundary is not asked. Looks first at the guess.
template <class Passes>
HWY_INLINE VI last_passed(const std::vector<float>& boundaries, VI guess, int least, Passes&& passes) {
  const auto count = static_cast<std::int32_t>(boundaries.size()) - 1;
  const VI zero = Zero(DI()), from = all(least), to = all(count + least);
  const auto at = [&](VI index) { return RebindMask(DI(), passes(gathered(boundaries, index))); };
  VI index = Min(Max(guess, from), to);
  for (;;) {
    const VI next = index + all(1);
    const auto goes_on = And(index < to, at(Min(next, to)));
    if (AllFalse(DI(), goes_on)) break;
    index = IfThenElse(goes_on, next, index);
  }
  for (;;) {
    const auto goes_back = AndNot(at(Max(index, zero)), index > from);
    if (AllFalse(DI(), goes_back)) return index;
    index = IfThenElse(goes_back, index - all(1), index);
  }
}

HWY_INLINE VI guessed(const BoundaryAxis& axis, V value) {
  const V at = (value - all(axis.start)) * all(axis.per_length);
  const V most = all(static_cast<float>(axis.boundaries.size()));
  return ConvertTo(DI(), Min(Max(at, Zero(D())), most));
}

struct Indices {
  VI first, last;
};

// Looks first where a value is guessed to be.
HWY_INLINE VI first_touched(const std::vector<float>& boundaries, VI guess, V low) {
  return last_passed(boundaries, guess, 0, [&](V boundary) { return boundary < low; });
}
HWY_INLINE VI last_touched(const std::vector<float>& boundaries, VI guess, V high) {
  return last_passed(boundaries, guess, -1, [&](V boundary) { return boundary <= high; });
}

// grid::intervals_touched for low <= high. Empty if first > last.
HWY_INLINE Indices touched(const BoundaryAxis& axis, V low, V high) {
  return {first_touched(axis.boundaries, guessed(axis, low), low),
          last_touched(axis.boundaries, guessed(axis, high), high)};
}

}  // namespace clusterbench::assign::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
