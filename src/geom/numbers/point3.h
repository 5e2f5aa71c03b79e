#pragma once
// Points and vectors over any number type.

#include <cmath>

#include "geom/numbers/precision.h"

namespace clusterbench::geom {

template <class Real>
struct Point3 {
  Real x, y, z;

  friend Point3 operator+(const Point3& a, const Point3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Point3 operator-(const Point3& a, const Point3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Point3 operator*(const Real& s, const Point3& a) { return {s * a.x, s * a.y, s * a.z}; }
  friend bool operator==(const Point3& a, const Point3& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
  friend Real dot(const Point3& a, const Point3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  friend Point3 cross(const Point3& a, const Point3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  friend Real length(const Point3& a) { return SquareRoot<Real>::of(dot(a, a)); }
};

// A unit vector across `axis`, towards n where n has such a part. The rounding error of the subtraction may be a large
// share of the remaining vector; a second subtraction removes the part along the axis.
template <class Real>
Point3<Real> unit_across(const Point3<Real>& axis, const Point3<Real>& n) {
  const Point3<Real> part = n - dot(n, axis) * axis;
  const Real size = length(part);
  if (size * size > Real(0.01) * dot(n, n)) return (Real(1) / size) * part;
  if (size > Real(1e-110)) {
    const Point3<Real> once = (Real(1) / size) * part;
    const Point3<Real> twice = once - dot(once, axis) * axis;
    const Real left = length(twice);
    if (left > Real(0.5)) return (Real(1) / left) * twice;
  }
  const bool x_is_small = axis.x * axis.x < Real(0.5);
  const Point3<Real> other =
      x_is_small ? Point3<Real>{Real(1), Real(0), Real(0)} : Point3<Real>{Real(0), Real(1), Real(0)};
  const Point3<Real> perpendicular = cross(axis, other);
  return (Real(1) / length(perpendicular)) * perpendicular;
}

}  // namespace clusterbench::geom
