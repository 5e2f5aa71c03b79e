#pragma once
// The volume of a light: a ball, or (a spot) the part of it in a cone around an axis. As exact ingredients, and
// computed from these in any number type. A type of light with another volume is one more alternative of LightVolume;
// the compiler then names all that asks for one.

#include <cmath>
#include <variant>

#include "geom/numbers/point3.h"
#include "geom/shapes/placement.h"

namespace clusterbench::geom {

// A point's, by its exact ingredients.
struct BallVolume {
  Placement center;
  double range = 0.0;  // > 0, may be +inf
};

// A spot's. The axis is rotation * direction, not necessarily of unit length.
struct SpotVolume {
  Placement apex;
  double range = 0.0;  // > 0, may be +inf
  Vec3d direction{0.0, 0.0, -1.0};
  double half_angle_rad = 0.0;
};

using LightVolume = std::variant<BallVolume, SpotVolume>;

// From where a light shines.
inline const Placement& source_of(const BallVolume& ball) {
  return ball.center;
}
inline const Placement& source_of(const SpotVolume& spot) {
  return spot.apex;
}
inline const Placement& source_of(const LightVolume& light) {
  return std::visit([](const auto& volume) -> const Placement& { return source_of(volume); }, light);
}
inline double range_of(const LightVolume& light) {
  return std::visit([](const auto& volume) { return volume.range; }, light);
}
inline LightVolume with_range(LightVolume light, double range) {
  std::visit([&](auto& volume) { volume.range = range; }, light);
  return light;
}

// A ball, or a ball ∩ cone, in a number type: searches and filters take both alike.
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
Volume<Real> volume_of(const SpotVolume& light) {
  using std::cos;
  using std::sin;
  Volume<Real> volume;
  volume.apex = local_point_in<Real>(light.apex);
  volume.range = Real(light.range);
  volume.is_cone = true;
  const Point3<Real> axis = local_point_in<Real>({light.direction, Vec3d(0.0), light.apex.rotation});
  volume.axis = (Real(1) / length(axis)) * axis;
  volume.cos_angle = cos(Real(light.half_angle_rad));
  volume.sin_angle = sin(Real(light.half_angle_rad));
  return volume;
}
// Its axis and angle are any.
template <class Real>
Volume<Real> volume_of(const BallVolume& light) {
  Volume<Real> volume = volume_of<Real>(SpotVolume{light.center, light.range});
  volume.is_cone = false;
  return volume;
}
template <class Real>
Volume<Real> volume_of(const LightVolume& light) {
  return std::visit([](const auto& alternative) { return volume_of<Real>(alternative); }, light);
}

// Without the range beyond what matters: `reach` is the largest distance from the origin that does.
template <class Real>
Volume<Real> within(Volume<Real> volume, const Real& reach) {
  const Real enough = Real(2) * (length(volume.apex) + reach);
  if (volume.range > enough) volume.range = enough;
  return volume;
}

}  // namespace clusterbench::geom
