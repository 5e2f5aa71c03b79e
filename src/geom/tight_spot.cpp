#include "geom/tight_spot.h"

#include <numbers>

#include "geom/search.h"

namespace clusterbench::geom {
namespace {

const Tight k_zero(0.0);

Tight squared(const Tight& value) {
  return value * value;
}

}  // namespace

TightSpot::TightSpot(const LightVolume& light, double range_m)
    : apex(placed<Tight>(light.apex)),
      direction(placed<Tight>({light.direction, Vec3d(0.0), light.apex.rotation})),
      range(range_m) {
  // The double nearest to pi / 2 is below it.
  const TightAngle angle = tight_angle(Tight(std::min(light.half_angle_rad, std::numbers::pi / 2.0)));
  cosine = angle.cosine;
  sine = angle.sine;
}

// Inside of the cone's side: sin² along² > cos² across², which keeps its digits for narrow cones.
Verdict TightSpot::leans(const TightPoint& way) const {
  const Tight along = dot(way, direction);
  if (!(k_zero < along)) return Verdict::open;
  const TightPoint across = cross(way, direction);
  const Tight inside = squared(sine * along), outside = squared(cosine) * dot(across, across);
  return outside < inside ? Verdict::yes : inside < outside ? Verdict::no : Verdict::open;
}

// cos along + sin across < 0
bool TightSpot::surely_leans_away(const TightPoint& way) const {
  const Tight along = dot(way, direction);
  if (!(along < k_zero)) return false;
  const TightPoint across = cross(way, direction);
  return squared(sine) * dot(across, across) < squared(cosine * along);
}

bool TightSpot::surely_holds(const TightPoint& p) const {
  const TightPoint v = p - apex;
  return dot(v, v) < squared(range) && leans(v) == Verdict::yes;
}

// The volume extends from its apex along a unit vector w by range if w is in the cone, else by range times
// cos(angle of w to the axis - half-angle), if that is positive.
bool TightSpot::surely_separated(const TightPoint& normal, const std::array<TightPoint, 8>& corners) const {
  const Tight size = dot(normal, normal), squared_reach = squared(range) * size;
  const Tight along = dot(normal, direction);
  const TightPoint across = cross(normal, direction);
  const Tight squared_across = dot(across, across);
  const bool is_outside = along < k_zero || squared(sine * along) < squared(cosine) * squared_across;
  // |direction| times the extent of the normal, both without unit length.
  const Tight lean = cosine * along + sine * sqrt(squared_across);
  const bool is_behind = is_outside && lean < k_zero;
  const Tight axis_size = dot(direction, direction), squared_extent = squared(range * lean);
  for (const TightPoint& corner : corners) {
    const Tight least = dot(normal, corner - apex);
    if (!(k_zero < least)) return false;
    if (is_behind) continue;
    const Tight square = squared(least);
    if (!(squared_reach < square) && !(is_outside && squared_extent < square * axis_size)) return false;
  }
  return true;
}

}  // namespace clusterbench::geom
