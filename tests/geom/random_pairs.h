#pragma once
// Random lights and cells, for tests.

#include <cmath>

#include "core/random.h"
#include "geom/shapes/cell.h"
#include "geom/shapes/light_volume.h"

namespace clusterbench::geom {

inline Vec3d random_direction(SplitMix64& random) {
  for (;;) {
    const Vec3d v{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    const double size = glm::length(v);
    if (size > 0.1 && size <= 1.0) return v / size;
  }
}

inline SpotVolume random_spot(SplitMix64& random) {
  SpotVolume light;
  light.apex.position = {random.between(-20, 20), random.between(-20, 20), random.between(-60, 5)};
  light.range = random.between(0.5, 20.0);
  light.direction = random_direction(random);
  light.half_angle_rad = random.between(0.01, 1.5707);
  return light;
}

// The spot, or the ball of its range.
inline LightVolume spot_or_ball(const SpotVolume& spot, bool is_cone) {
  return is_cone ? LightVolume(spot) : BallVolume{spot.apex, spot.range};
}
inline LightVolume random_light(SplitMix64& random, bool is_cone) {
  return spot_or_ball(random_spot(random), is_cone);
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

inline FrustumCell random_piece(SplitMix64& random) {
  const Slopes s = random_slopes(random);
  return {s.x0, s.x1, s.y0, s.y1, s.near, s.far, false};
}

inline ShellCell random_shell(SplitMix64& random) {
  const Slopes s = random_slopes(random);
  return {s.x0, s.x1, s.y0, s.y1, s.near, s.far};
}

inline bool volume_holds(const LightVolume& light, const Vec3d& p) {
  const Vec3d v = p - source_of(light).position;
  const double distance = glm::length(v);
  if (distance > range_of(light)) return false;
  const auto* spot = std::get_if<SpotVolume>(&light);
  return spot == nullptr || glm::dot(v, spot->direction) >= std::cos(spot->half_angle_rad) * distance;
}

inline Box random_box(SplitMix64& random) {
  const FrustumCell p = random_piece(random);
  return {{8.0f * p.x0, 8.0f * p.y0, -p.depth1}, {8.0f * p.x1, 8.0f * p.y1, -p.depth0}};
}

// A random point of the cell; spread is uniform in slope and depth or distance.
inline Vec3d point_of(const FrustumCell& c, SplitMix64& random) {
  const double depth = random.between(c.depth0, c.depth1);
  return {random.between(c.x0, c.x1) * depth, random.between(c.y0, c.y1) * depth, -depth};
}
inline Vec3d point_of(const ShellCell& c, SplitMix64& random) {
  const Vec3d ray{random.between(c.x0, c.x1), random.between(c.y0, c.y1), -1.0};
  return random.between(c.distance0, c.distance1) / glm::length(ray) * ray;
}

// A place on a cell's surface and a direction out of the cell there: of its face, or one between those of the faces
// that meet there.
struct Contact {
  Vec3d place, outward;
};

inline Contact random_contact(const Slopes& s, bool is_shell, SplitMix64& random) {
  const double lo[3] = {s.x0, s.y0, s.near}, hi[3] = {s.x1, s.y1, s.far};
  double at[3];
  int side[3] = {0, 0, 0};
  while (side[0] == 0 && side[1] == 0 && side[2] == 0)
    for (int i = 0; i < 3; ++i) {
      side[i] = static_cast<int>(random.below(3)) - 1;
      at[i] = side[i] == 0 ? random.between(lo[i], hi[i]) : side[i] < 0 ? lo[i] : hi[i];
    }
  const Vec3d slopes{at[0], at[1], -1}, ray = is_shell ? glm::normalize(slopes) : slopes;
  const Vec3d normals[3] = {glm::normalize(Vec3d(1, 0, at[0])), glm::normalize(Vec3d(0, 1, at[1])),
                            is_shell ? ray : Vec3d(0, 0, -1)};
  Vec3d outward(0);
  for (int i = 0; i < 3; ++i) outward += side[i] * random.between(0.05, 1) * normals[i];
  return {at[2] * ray, glm::normalize(outward)};
}

enum class By { ball, cap, rim, side };

// How far from its apex a light reaches a place, and by how much: metres, of its side radians.
struct Reach {
  double along, half_angle, margin;
};

// A light that reaches the place with one part of its surface, and lies outward of it there.
inline LightVolume light_against(const Contact& contact, By by, const Reach& reach, SplitMix64& random) {
  const auto& [along, half_angle, margin] = reach;
  SpotVolume light;
  light.half_angle_rad = half_angle;
  // From the apex to the place: against the cap's outward direction, along the side, or between them at the rim.
  const double lean = by == By::side ? M_PI / 2 : by == By::rim ? random.between(0.1, 1.4) : 0.0;
  const Vec3d beside = glm::normalize(glm::cross(contact.outward, random_direction(random)));
  const Vec3d towards = -std::cos(lean) * contact.outward + std::sin(lean) * beside;
  const Vec3d inward = std::sin(lean) * contact.outward + std::cos(lean) * beside;
  const double off_axis = by == By::cap ? random.unit() * half_angle : half_angle - margin;
  light.direction = std::cos(off_axis) * towards + std::sin(off_axis) * inward;
  light.apex.position = contact.place - along * towards;
  light.range = by == By::side ? along * random.between(1.1, 3.0) : along + margin;
  return spot_or_ball(light, by != By::ball);
}

}  // namespace clusterbench::geom
