#pragma once
// Exact numbers: what floats and doubles are, and what follows from them by + - * /.

#include <boost/multiprecision/cpp_int.hpp>

#include "geom/candidates.h"
#include "geom/placement.h"
#include "geom/squares.h"

namespace clusterbench::geom {

using Integer = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>, boost::multiprecision::et_off>;
using Rational =
    boost::multiprecision::number<boost::multiprecision::cpp_rational::backend_type, boost::multiprecision::et_off>;
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

inline RationalPoint exact_point(const Placement& place) {
  Rational t[3], local[3];
  for (int i = 0; i < 3; ++i) t[i] = exact(place.position[i]) - exact(place.origin[i]);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) local[row] += exact(place.rotation[column][row]) * t[column];
  return {local[0], local[1], local[2]};
}

}  // namespace clusterbench::geom
