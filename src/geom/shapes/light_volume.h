#pragma once
// The volume of a light: a ball, or (a spot) the part of it in a cone around an axis. As exact ingredients, and
// computed from these in any number type.

#include <cmath>

#include "geom/numbers/point3.h"
#include "geom/shapes/placement.h"

namespace clusterbench::geom {

// A light by its exact ingredients. The axis is rotation * direction, not necessarily of unit length.
struct LightVolume {
  Placement apex;
  double range = 0.0;  // > 0, may be +inf
  bool is_cone = false;
  Vec3d direction{0.0, 0.0, -1.0};
  double half_angle_rad = 0.0;
};

// A light's volume in a number type.
template <class Real>
struct Volume {
  Point3<Real> apex;
  Point3<Real> axis;  // unit
  Real range, cos_angle, sin_angle;
  bool is_cone;

  // How far inside the cone's side a point is; negative outside. Never more than `along`, which only an angle of 0
  // needs said.
  Real side_margin(const Point3<Real>& p) const {
    const Point3<Real> v = p - apex;
    const Real along = dot(v, axis);
    const Real side = sin_angle * along - cos_angle * length(v - along * axis);
    return side < along ? side : along;
  }
  // How far the volume extends from its apex in a unit direction.
  Real extent(const Point3<Real>& direction) const {
    if (!is_cone) return range;
    const Real along = dot(direction, axis);
    if (!(along < cos_angle)) return range;
    const Real lean = cos_angle * along + sin_angle * length(direction - along * axis);
    return lean > Real(0) ? range * lean : Real(0);
  }
};

// An infinite range stays infinite.
template <class Real>
Volume<Real> volume_of(const LightVolume& light) {
  using std::cos;
  using std::sin;
  Volume<Real> volume;
  volume.apex = local_point_in<Real>(light.apex);
  volume.range = Real(light.range);
  volume.is_cone = light.is_cone;
  const Point3<Real> axis = local_point_in<Real>({light.direction, Vec3d(0.0), light.apex.rotation});
  volume.axis = (Real(1) / length(axis)) * axis;
  volume.cos_angle = cos(Real(light.half_angle_rad));
  volume.sin_angle = sin(Real(light.half_angle_rad));
  return volume;
}

// Without the range beyond what matters: `reach` is the largest distance from the origin that does.
template <class Real>
Volume<Real> within(Volume<Real> volume, const Real& reach) {
  const Real enough = Real(2) * (length(volume.apex) + reach);
  if (volume.range > enough) volume.range = enough;
  return volume;
}

}  // namespace clusterbench::geom
