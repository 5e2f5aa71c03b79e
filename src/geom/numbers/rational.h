#pragma once
// Exact numbers: floats, doubles, and results of + - * / on them. They are Boost's; where the library for engines is
// built without Boost, its own (CLUSTERBENCH_OWN_NUMBERS).

#if CLUSTERBENCH_OWN_NUMBERS
#include "geom/numbers/own_rational.h"
#else
#include <boost/multiprecision/cpp_int.hpp>
#endif

#include "geom/numbers/point3.h"
#include "geom/numbers/square_roots.h"

namespace clusterbench::geom {

#if CLUSTERBENCH_OWN_NUMBERS
using own_numbers::Integer;
using own_numbers::Rational;
#else
using Integer = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>, boost::multiprecision::et_off>;
using Rational =
    boost::multiprecision::number<boost::multiprecision::cpp_rational::backend_type, boost::multiprecision::et_off>;
#endif
using RationalPoint = Point3<Rational>;

// value: finite.
inline Rational exact(double value) {
  return Rational(value);
}

inline RationalPoint exact(const Point3<double>& p) {
  return {exact(p.x), exact(p.y), exact(p.z)};
}

inline Rational norm_1(const RationalPoint& p) {
  return abs(p.x) + abs(p.y) + abs(p.z);
}

inline Rational squared_distance(const RationalPoint& a, const RationalPoint& b) {
  return dot(a - b, a - b);
}

}  // namespace clusterbench::geom
