#pragma once
// A point stored in exact numbers: local = rotation * (position - origin), every number used exactly.

#include <algorithm>
#include <cmath>

#include "geom/numbers/point3.h"
#include "geom/shapes/vec.h"

namespace clusterbench::geom {

struct Placement {
  Vec3d position{0.0}, origin{0.0};
  Mat3d rotation{1.0};
};

// The local point in double precision. Each coordinate is off by less than rounding_error.
struct LocalPoint {
  Vec3d at{0.0};
  double rounding_error = 0.0;
};

inline LocalPoint local_point(const Placement& placement) {
  const Vec3d t = placement.position - placement.origin;
  // Three products, two sums and the subtraction before them: under 5 unit roundoffs of the sum of magnitudes; 8 are
  // used.
  constexpr double k_roundoffs = 0x1p-50;
  double error = 0.0;
  for (int row = 0; row < 3; ++row) {
    double magnitude = 0.0;
    for (int column = 0; column < 3; ++column) magnitude += std::abs(placement.rotation[column][row] * t[column]);
    error = std::max(error, magnitude * k_roundoffs);
  }
  return {placement.rotation * t, error};
}

// The local point in any number type.
template <class Real>
Point3<Real> local_point_in(const Placement& placement) {
  Real t[3], local[3];
  for (int i = 0; i < 3; ++i) t[i] = Real(placement.position[i]) - Real(placement.origin[i]);
  for (int row = 0; row < 3; ++row) {
    local[row] = Real(0);
    for (int column = 0; column < 3; ++column) local[row] += Real(placement.rotation[column][row]) * t[column];
  }
  return {local[0], local[1], local[2]};
}

}  // namespace clusterbench::geom
