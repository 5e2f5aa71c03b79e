#pragma once
// Random lights and cells, for tests.

#include <cmath>

#include "core/random.h"
#include "geom/light_volume.h"
#include "geom/shapes.h"

namespace clusterbench::geom {

inline Vec3d random_direction(SplitMix64& random) {
  for (;;) {
    const Vec3d v{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    const double size = glm::length(v);
    if (size > 0.1 && size <= 1.0) return v / size;
  }
}

inline LightVolume random_light(SplitMix64& random, bool is_cone) {
  LightVolume light;
  light.apex.position = {random.between(-20, 20), random.between(-20, 20), random.between(-60, 5)};
  light.range = random.between(0.5, 20.0);
  light.is_cone = is_cone;
  light.direction = random_direction(random);
  light.half_angle_rad = random.between(0.01, 1.5707);
  return light;
}

struct Slopes {
  float x0, x1, y0, y1, near, far;
};

inline Slopes random_slopes(SplitMix64& random) {
  const auto f = [&](double lo, double hi) { return static_cast<float>(random.between(lo, hi)); };
  Slopes s{f(-1, 0.8), 0, f(-1, 0.8), 0, f(0.1, 50), 0};
  s.x1 = s.x0 + f(0.01, 0.3);
  s.y1 = s.y0 + f(0.01, 0.3);
  s.far = s.near + f(0.1, 10);
  return s;
}

inline FrustumPiece random_piece(SplitMix64& random) {
  const Slopes s = random_slopes(random);
  return {s.x0, s.x1, s.y0, s.y1, s.near, s.far, false};
}

inline ShellPiece random_shell(SplitMix64& random) {
  const Slopes s = random_slopes(random);
  return {s.x0, s.x1, s.y0, s.y1, s.near, s.far};
}

inline bool volume_holds(const LightVolume& light, const Vec3d& p) {
  const Vec3d v = p - light.apex.position;
  const double distance = glm::length(v);
  if (distance > light.range) return false;
  return !light.is_cone || glm::dot(v, light.direction) >= std::cos(light.half_angle_rad) * distance;
}

inline Box random_box(SplitMix64& random) {
  const FrustumPiece p = random_piece(random);
  return {{8.0f * p.x0, 8.0f * p.y0, -p.depth1}, {8.0f * p.x1, 8.0f * p.y1, -p.depth0}};
}

// A random point of the cell; spread is uniform in slope and depth or distance.
inline Vec3d point_of(const FrustumPiece& c, SplitMix64& random) {
  const double depth = random.between(c.depth0, c.depth1);
  return {random.between(c.x0, c.x1) * depth, random.between(c.y0, c.y1) * depth, -depth};
}
inline Vec3d point_of(const ShellPiece& c, SplitMix64& random) {
  const Vec3d ray{random.between(c.x0, c.x1), random.between(c.y0, c.y1), -1.0};
  return random.between(c.distance0, c.distance1) / glm::length(ray) * ray;
}

}  // namespace clusterbench::geom
