#pragma once
// The distance of a ball's centre from an interval of one coordinate, in numbers with error bounds.

#include <algorithm>

#include "geom/ball/pyramid_slab.h"
#include "geom/numbers/bounded_double.h"
#include "geom/numbers/enclosure_106.h"

namespace clusterbench::geom {

// An approximate value of a number.
inline double about(const Bounded& number) {
  return number.value;
}
inline double about(const Enclosure106& number) {
  return number.middle().hi;
}

inline double error_of(const Bounded& number) {
  return number.error;
}
inline double error_of(const Enclosure106& number) {
  return number.radius();
}

inline Bounded widened(const Bounded& number, double by) {
  return {number.value, bounded::rounded_up(number.error + by)};
}
inline Enclosure106 widened(const Enclosure106& number, double by) {
  return {number.middle(), (number.radius() + by) * (1.0 + 0x1p-40)};
}

// The largest of a, b and 0.
inline Enclosure106 largest_or_zero(const Enclosure106& a, const Enclosure106& b) {
  const DoubleDouble middle = a.middle() < b.middle() ? b.middle() : a.middle();
  const double radius = std::max(a.radius(), b.radius());
  if (middle.hi > 0.0) return {middle, radius};
  return {DoubleDouble(), -0.5 * middle.hi > radius ? 0.0 : radius};
}

// The distance of a centre outside of low <= x <= high, and the side.
template <class Number>
struct Gap {
  Number size;
  Side side;
};
template <class Number>
Gap<Number> gap_between(const Number& low, const Number& at, const Number& high) {
  const Number below = low - at, above = at - high;
  const Number size = largest_or_zero(below, above);
  if (about(size) > 0.0) return {size, about(below) > about(above) ? Side::low : Side::high};
  return {size, Side::between};
}

inline Side side_of(double low, double at, double high) {
  return at < low ? Side::low : at > high ? Side::high : Side::between;
}

// The signed distance from the centre to the other end of a gap. If the side is uncertain, the gap is smaller than its
// error.
inline Bounded across(const Gap<Bounded>& gap) {
  return gap.side == Side::high ? -gap.size : gap.size;
}

}  // namespace clusterbench::geom
