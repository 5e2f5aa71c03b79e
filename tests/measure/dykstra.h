#pragma once
// An independent answer to "how far is the apex of a cone from cell ∩ cone": Dykstra's alternating projections onto the
// six planes and the cone, which converge to the nearest point of their intersection (Boyle, Dykstra 1986).

#include <algorithm>
#include <array>
#include <cmath>

#include "geom/shapes/cell.h"

namespace clusterbench::test {

struct DykstraCone {
  Vec3d apex, axis;
  double half_angle_rad;
};

inline Vec3d onto_cone(const DykstraCone& cone, const Vec3d& p) {
  const Vec3d v = p - cone.apex;
  const double along = glm::dot(v, cone.axis);
  const Vec3d across = v - along * cone.axis;
  const double size = glm::length(across), c = std::cos(cone.half_angle_rad), s = std::sin(cone.half_angle_rad);
  if (c * size <= s * along) return p;
  const double on_side = c * along + s * size;  // coordinate along the nearest generator
  if (on_side <= 0.0) return cone.apex;
  return cone.apex + on_side * (c * cone.axis + s / size * across);
}

// normal·p <= offset, unit normal.
struct DykstraPlane {
  Vec3d normal;
  double offset;
};

inline Vec3d onto_plane(const DykstraPlane& plane, const Vec3d& p) {
  return p - std::max(0.0, glm::dot(plane.normal, p) - plane.offset) * plane.normal;
}

inline std::array<DykstraPlane, 6> planes_of(const geom::FrustumCell& c) {
  const auto side = [](double x, double y, double z) { return DykstraPlane{glm::normalize(Vec3d(x, y, z)), 0.0}; };
  return {side(-1, 0, -c.x0),
          side(1, 0, c.x1),
          side(0, -1, -c.y0),
          side(0, 1, c.y1),
          DykstraPlane{{0, 0, 1}, -static_cast<double>(c.depth0)},
          DykstraPlane{{0, 0, -1}, static_cast<double>(c.depth1)}};
}

struct DykstraResult {
  double distance;   // from the apex to the point reached
  double violation;  // how far that point is outside of some set: small if there is a common point
};

inline DykstraResult distance_to_common_point(const DykstraCone& cone, const geom::FrustumCell& cell, int rounds) {
  const std::array<DykstraPlane, 6> planes = planes_of(cell);
  std::array<Vec3d, 7> correction{};
  correction.fill(Vec3d(0.0));
  Vec3d p = cone.apex;
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t set = 0; set < 7; ++set) {
      const Vec3d from = p + correction[set];
      p = set < 6 ? onto_plane(planes[set], from) : onto_cone(cone, from);
      correction[set] = from - p;
    }
  }
  double violation = glm::length(p - onto_cone(cone, p));
  for (const DykstraPlane& plane : planes) violation = std::max(violation, glm::length(p - onto_plane(plane, p)));
  return {glm::length(p - cone.apex), violation};
}

}  // namespace clusterbench::test
