#pragma once
// Random lights and cells at the scales of maps: kilometres from the eye, ranges of centimetres, cones of 1e-5 rad,
// slopes up to 1e4. The light reaches the cell, or misses it, by anything from its own size to a rounding of it.

#include <algorithm>
#include <array>

#include "geom/random_pairs.h"
#include "geom/shapes/cell.h"
#include "geom/shapes/light_volume.h"

namespace clusterbench::geom {

// Every order of magnitude is equally likely.
inline double log_between(double lo, double hi, SplitMix64& random) {
  return lo * std::pow(hi / lo, random.unit());
}

// Slopes of a tile; one in four is far to the side.
inline Slopes map_tile(SplitMix64& random) {
  const auto interval = [&](float& lo, float& hi) {
    const double size = random.below(4) == 0 ? log_between(1.0, 1e4, random) : random.unit();
    const double middle = random.below(2) == 0 ? size : -size;
    const double half = 0.5 * log_between(1e-3, 0.5, random) * (0.1 + size);
    lo = static_cast<float>(middle - half);
    hi = static_cast<float>(middle + half);
  };
  Slopes s{};
  interval(s.x0, s.x1);
  interval(s.y0, s.y1);
  return s;
}

// A tile cut at about a distance (or depth) from the eye: as thick as the light is long, or from near to far.
inline Slopes map_slopes(double distance, double range, SplitMix64& random) {
  Slopes s = map_tile(random);
  const auto off = [&] { return range * random.between(0.0, 2.0); };
  s.near = static_cast<float>(random.below(3) == 0 ? 0.1 : std::max(0.1, distance - off()));
  s.far = static_cast<float>(distance + (random.below(3) == 0 ? distance : off()));
  if (!(s.far > s.near)) s.far = std::nextafter(s.near, 1e9f);
  return s;
}

struct MapPair {
  LightVolume light;
  Cell cell;
};

inline MapPair map_pair(bool is_shell, bool is_cone, SplitMix64& random) {
  const double distance = log_between(1.0, 1e4, random), range = std::min(distance, log_between(0.01, 100.0, random));
  const double half_angle = random.below(4) == 0 ? log_between(1e-5, 1.5, random) : random.between(0.01, 1.5);
  const double margin = (random.below(2) == 0 ? 1.0 : -1.0) * log_between(1e-17, 0.5, random);
  const By by = is_cone ? std::array{By::cap, By::rim, By::side}[random.below(3)] : By::ball;
  const Slopes s = map_slopes(distance, range, random);
  const Reach reach{range, half_angle, margin * (by == By::side ? half_angle : range)};
  LightVolume light = light_against(random_contact(s, is_shell, random), by, reach, random);
  if (is_shell) return {light, ShellCell{s.x0, s.x1, s.y0, s.y1, s.near, s.far}};
  return {light, FrustumCell{s.x0, s.x1, s.y0, s.y1, s.near, s.far, false}};
}

}  // namespace clusterbench::geom
