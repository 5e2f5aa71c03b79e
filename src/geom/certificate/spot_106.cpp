#include "geom/certificate/spot_106.h"

#include <numbers>

#include "geom/shapes/light_volume.h"
#include "geom/shapes/placement.h"

namespace clusterbench::geom {
namespace {

const Enclosure106 k_zero(0.0);

Enclosure106 squared(const Enclosure106& value) {
  return value * value;
}

}  // namespace

Spot106::Spot106(const SpotVolume& light, double range_m)
    : apex(local_point_in<Enclosure106>(light.apex)),
      direction(local_point_in<Enclosure106>({light.direction, Vec3d(0.0), light.apex.rotation})),
      range(range_m) {
  // The double nearest to pi / 2 is below pi / 2.
  const Angle106 angle = angle_106(Enclosure106(std::min(light.half_angle_rad, std::numbers::pi / 2.0)));
  cosine = angle.cosine;
  sine = angle.sine;
}

// Is it inside the cone's side: sin² along² > cos² across²? This form keeps its digits for narrow cones.
Verdict Spot106::leans(const Point106& way) const {
  const Enclosure106 along = dot(way, direction);
  if (!(k_zero < along)) return Verdict::uncertain;
  const Point106 across = cross(way, direction);
  const Enclosure106 inside = squared(sine * along), outside = squared(cosine) * dot(across, across);
  return outside < inside ? Verdict::yes : inside < outside ? Verdict::no : Verdict::uncertain;
}

// cos along + sin across < 0
bool Spot106::surely_leans_away(const Point106& way) const {
  const Enclosure106 along = dot(way, direction);
  if (!(along < k_zero)) return false;
  const Point106 across = cross(way, direction);
  return squared(sine) * dot(across, across) < squared(cosine * along);
}

bool Spot106::surely_holds(const Point106& p) const {
  const Point106 v = p - apex;
  return dot(v, v) < squared(range) && leans(v) == Verdict::yes;
}

// Is the extent of the volume from its apex along a normal (of any length) certainly below all of these? Along a unit
// vector w the extent is range if w is in the cone, else range times cos(angle of w to the axis - half-angle), if that
// is positive.
template <std::size_t N>
bool Spot106::is_surely_below(const Point106& normal, const std::array<Enclosure106, N>& least) const {
  const Enclosure106 size = dot(normal, normal), squared_reach = squared(range) * size;
  const Enclosure106 along = dot(normal, direction);
  const Point106 across = cross(normal, direction);
  const Enclosure106 squared_across = dot(across, across);
  const bool is_outside = along < k_zero || squared(sine * along) < squared(cosine) * squared_across;
  // |direction| times the extent along the normal; both vectors are not of unit length.
  const Enclosure106 lean = cosine * along + sine * sqrt(squared_across);
  const bool is_behind = is_outside && lean < k_zero;
  const Enclosure106 axis_size = dot(direction, direction), squared_extent = squared(range * lean);
  return std::all_of(least.begin(), least.end(), [&](const Enclosure106& distance) {
    if (!(k_zero < distance)) return false;
    if (is_behind) return true;
    const Enclosure106 square = squared(distance);
    return squared_reach < square || (is_outside && squared_extent < square * axis_size);
  });
}

bool Spot106::surely_separated(const Point106& normal, const std::array<Point106, 8>& corners) const {
  std::array<Enclosure106, 8> least;
  for (std::size_t i = 0; i < 8; ++i) least[i] = dot(normal, corners[i] - apex);
  return is_surely_below(normal, least);
}

bool Spot106::surely_separated(const Point106& normal, const Enclosure106& radius) const {
  return is_surely_below<1>(normal, {-dot(normal, apex) - radius * sqrt(dot(normal, normal))});
}

}  // namespace clusterbench::geom
