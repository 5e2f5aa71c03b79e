#include "geom/certificate/rational_spot.h"

#include <algorithm>
#include <limits>
#include <numbers>

namespace clusterbench::geom {
namespace {

// The bound that makes factor * value largest.
const Rational& largest_for(const Rational& factor, const RationalInterval& value) {
  return factor.sign() < 0 ? value.lo : value.hi;
}

}  // namespace

ExactSpot exact_spot(const SpotVolume& light, unsigned angle_bits) {
  ExactSpot spot;
  spot.apex = local_point_in<Rational>(light.apex);
  spot.direction = local_point_in<Rational>({light.direction, Vec3d(0.0), light.apex.rotation});
  spot.range = exact(std::min(light.range, std::numeric_limits<double>::max()));
  // The double nearest to pi / 2 is below pi / 2.
  spot.half_angle_rad = exact(std::min(light.half_angle_rad, std::numbers::pi / 2.0));
  spot.half_angle = bounds_of_angle(spot.half_angle_rad, angle_bits);
  return spot;
}

bool surely_leans(const ExactSpot& spot, const RationalPoint& v) {
  const Rational along = dot(v, spot.direction);
  return along.sign() >= 0 &&
         squared(along) >= squared(spot.half_angle.cosine.hi) * dot(v, v) * dot(spot.direction, spot.direction);
}

bool surely_holds(const ExactSpot& spot, const RationalPoint& p) {
  return squared_distance(p, spot.apex) <= squared(spot.range) && surely_leans(spot, p - spot.apex);
}

// The extent of the volume from its apex along a unit vector w is range if w is in the cone, else range times cos(angle
// of w to the axis - half-angle), if that is positive.
bool surely_separates(const RationalPoint& normal, const ExactSpot& spot, const std::array<RationalPoint, 8>& corners) {
  Rational least = dot(normal, corners[0] - spot.apex);
  for (const RationalPoint& corner : corners) least = std::min(least, dot(normal, corner - spot.apex));
  if (least.sign() <= 0) return false;
  const Rational size = dot(normal, normal), axis_size = dot(spot.direction, spot.direction);
  if (squared(least) > squared(spot.range) * size) return true;
  const auto& [cosine, sine] = spot.half_angle;
  const Rational along = dot(normal, spot.direction);
  const bool is_outside = along.sign() <= 0 || squared(along) <= squared(cosine.lo) * size * axis_size;
  if (!is_outside) return false;
  // |direction| times the extent along the normal; both vectors are not of unit length.
  const Rational lean = largest_for(along, cosine) * along + sine.hi * root_above(size * axis_size - squared(along));
  return lean.sign() <= 0 || squared(least) * axis_size > squared(spot.range * lean);
}

}  // namespace clusterbench::geom
