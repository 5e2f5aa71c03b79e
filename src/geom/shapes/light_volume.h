#pragma once
// The volume of a light: a ball, or (a spot) the part of it in a cone around an axis, or a box. Stored as exact
// numbers, and converted from these to any number type. A light type with another volume is one more alternative of
// LightVolume; the compiler then reports all code that needs a case for it.

#include <array>
#include <cmath>
#include <variant>

#include "geom/numbers/point3.h"
#include "geom/shapes/placement.h"

namespace clusterbench::geom {

// A point light's volume, in exact numbers.
struct BallVolume {
  Placement center;
  double range = 0.0;  // > 0, may be +inf
};

// A spot's volume. The axis is rotation * direction, not necessarily of unit length.
struct SpotVolume {
  Placement apex;
  double range = 0.0;  // > 0, may be +inf
  Vec3d direction{0.0, 0.0, -1.0};
  double half_angle_rad = 0.0;
};

// A box's volume, with the middle and, in the space of its position, the half axes: all rotation * (position - origin +
// a * half_axes[0] + b * half_axes[1] + c * half_axes[2]) with a, b and c from -1 to 1. Half axes are arbitrary: a box
// without thickness is allowed, and so is a parallelepiped under a sheared scene node.
struct BoxVolume {
  Placement center;
  double range = 0.0;  // > 0, finite: no less than the distance of the farthest corner from the middle
  std::array<Vec3d, 3> half_axes{};
};

using LightVolume = std::variant<BallVolume, SpotVolume, BoxVolume>;

// The position from which a light shines.
inline const Placement& source_of(const BallVolume& ball) {
  return ball.center;
}
inline const Placement& source_of(const SpotVolume& spot) {
  return spot.apex;
}
inline const Placement& source_of(const BoxVolume& box) {
  return box.center;
}
inline const Placement& source_of(const LightVolume& light) {
  return std::visit([](const auto& volume) -> const Placement& { return source_of(volume); }, light);
}
inline double range_of(const LightVolume& light) {
  return std::visit([](const auto& volume) { return volume.range; }, light);
}
// The volume with another size: for a light its range, for a box its scale about its middle.
template <class Volume>
Volume with_range(Volume light, double range) {
  light.range = range;
  return light;
}
inline BoxVolume with_range(BoxVolume box, double range) {
  for (Vec3d& axis : box.half_axes) axis *= range / box.range;
  box.range = range;
  return box;
}
inline LightVolume with_range(const LightVolume& light, double range) {
  return std::visit([&](const auto& volume) { return LightVolume(with_range(volume, range)); }, light);
}

// A ball, or ball ∩ cone, in a number type: searches and filters handle both alike.
template <class Real>
struct Volume {
  Point3<Real> apex;
  Point3<Real> axis;  // unit
  Real range, cos_angle, sin_angle;
  bool is_cone;

  // The distance of a point inside the cone's side; negative outside. Never more than `along`; this limit matters only
  // for an angle of 0.
  Real side_margin(const Point3<Real>& p) const {
    const Point3<Real> v = p - apex;
    const Real along = dot(v, axis);
    const Real side = sin_angle * along - cos_angle * length(v - along * axis);
    return side < along ? side : along;
  }
  // The extent of the volume from its apex in a unit direction.
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
// A ball; its axis and angle have no meaning.
template <class Real>
Volume<Real> volume_of(const BallVolume& light) {
  Volume<Real> volume = volume_of<Real>(SpotVolume{light.center, light.range});
  volume.is_cone = false;
  return volume;
}

// Limits the range to the part that matters: `reach` is the largest relevant distance from the origin.
template <class Real>
Volume<Real> within(Volume<Real> volume, const Real& reach) {
  const Real enough = Real(2) * (length(volume.apex) + reach);
  if (volume.range > enough) volume.range = enough;
  return volume;
}

}  // namespace clusterbench::geom
