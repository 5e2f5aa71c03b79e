#include "pictures/colours.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clusterbench::pictures {
namespace {

constexpr Rgb k_viridis[] = {
#include "pictures/viridis.inc"
};
constexpr Rgb k_ambers[] = {{122, 70, 0}, {196, 118, 0}, {240, 160, 20}, {255, 205, 110}};
constexpr Rgb k_magentas[] = {{150, 20, 110}, {205, 50, 150}, {245, 110, 195}};

std::uint8_t channel(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

Rgb mixed(const Rgb& a, const Rgb& b, double share_of_b) {
  const auto mix = [&](std::uint8_t from, std::uint8_t to) { return channel(from + (to - from) * share_of_b); };
  return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b)};
}

Rgb along(std::span<const Rgb> scale, double share) {
  const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(scale.size() - 1);
  const std::size_t low = std::min(static_cast<std::size_t>(at), scale.size() - 2);
  return mixed(scale[low], scale[low + 1], at - static_cast<double>(low));
}

// A pure hue, 0 to 1 around the circle.
Rgb hue(double turn) {
  const auto wave = [&](double middle) {
    const double apart = std::abs(turn - middle), around = std::min(apart, 1.0 - apart);
    return channel(255.0 * std::clamp(2.0 - 6.0 * around, 0.0, 1.0));
  };
  return {wave(0.0), wave(1.0 / 3.0), wave(2.0 / 3.0)};
}

}  // namespace

std::vector<Rgb> basic_palette() {
  return {{255, 255, 255}, {24, 26, 31}, {98, 104, 115}, {198, 214, 234}, {40, 42, 48}, {228, 230, 235}, {52, 54, 60}};
}

Rgb lights_colour(double share) {
  return along(k_viridis, share);
}

Rgb false_positives_colour(double share) {
  return along(k_ambers, share);
}

Rgb missed_colour(double share) {
  return along(k_magentas, share);
}

Rgb shaded(const Rgb& colour, double light) {
  return mixed({0, 0, 0}, colour, light);
}

std::vector<Rgb> distinct_colours(int count) {
  constexpr double k_golden = 0.61803398875;  // multiples of this, modulo 1, are nowhere close to each other
  constexpr std::pair<double, double> k_tones[] = {{0.85, 0.25}, {1.0, 0.5}, {0.6, 0.1}};  // light, share of white
  std::vector<Rgb> colours;
  for (int i = 0; i < count; ++i) {
    const auto [light, white] = k_tones[static_cast<std::size_t>(i) % std::size(k_tones)];
    const double turn = i * k_golden;
    colours.push_back(shaded(mixed(hue(turn - std::floor(turn)), {255, 255, 255}, white), light));
  }
  return colours;
}

}  // namespace clusterbench::pictures
