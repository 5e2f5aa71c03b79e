#include "geom/certificate/spot_106.h"

#include <numbers>

#include "geom/shapes/light_volume.h"
#include "geom/shapes/placement.h"

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

// Does the volume certainly extend along a normal (of any length) from its apex by less than all of these? It extends
// along a unit vector w by range if w is in the cone, else by range times cos(angle of w to the axis - half-angle), if
// that is positive.
template <std::size_t N>
bool TightSpot::is_surely_below(const TightPoint& normal, const std::array<Tight, N>& least) const {
  const Tight size = dot(normal, normal), squared_reach = squared(range) * size;
  const Tight along = dot(normal, direction);
  const TightPoint across = cross(normal, direction);
  const Tight squared_across = dot(across, across);
  const bool is_outside = along < k_zero || squared(sine * along) < squared(cosine) * squared_across;
  // |direction| times the extent of the normal, both without unit length.
  const Tight lean = cosine * along + sine * sqrt(squared_across);
  const bool is_behind = is_outside && lean < k_zero;
  const Tight axis_size = dot(direction, direction), squared_extent = squared(range * lean);
  return std::all_of(least.begin(), least.end(), [&](const Tight& distance) {
    if (!(k_zero < distance)) return false;
    if (is_behind) return true;
    const Tight square = squared(distance);
    return squared_reach < square || (is_outside && squared_extent < square * axis_size);
  });
}

bool TightSpot::surely_separated(const TightPoint& normal, const std::array<TightPoint, 8>& corners) const {
  std::array<Tight, 8> least;
  for (std::size_t i = 0; i < 8; ++i) least[i] = dot(normal, corners[i] - apex);
  return is_surely_below(normal, least);
}

bool TightSpot::surely_separated(const TightPoint& normal, const Tight& radius) const {
  return is_surely_below<1>(normal, {-dot(normal, apex) - radius * sqrt(dot(normal, normal))});
}

}  // namespace clusterbench::geom
