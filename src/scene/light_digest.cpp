#include "scene/light_digest.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include "core/text.h"

namespace clusterbench::scene {
namespace {

using LightNumbers = std::array<std::uint32_t, 18>;

double size_of(const std::vector<WorldLight>& lights) {
  double size = 0.0;
  for (const WorldLight& light : lights) {
    for (int axis = 0; axis < 3; ++axis) size = std::max(size, std::abs(light.position[axis]));
    if (std::isfinite(light.range_m)) size = std::max(size, light.range_m);
  }
  return size;
}

// The bits of the number in single precision. What is far below the roundoffs of numbers of this size is nothing.
std::uint32_t bits_of(double value, double size) {
  if (!std::isfinite(value)) return std::bit_cast<std::uint32_t>(std::numeric_limits<float>::infinity());
  return std::abs(value) <= 0x1p-40 * size ? 0 : std::bit_cast<std::uint32_t>(static_cast<float>(value));
}

bool is_black(const WorldLight& light) {
  return light.type != LightType::box && !(light.luminous_intensity_cd > 0.0);
}

// Three even where nothing moves, so that lights which stand still have one digest, whatever else of the file moves.
std::array<double, 3> digest_times(const Scene& scene) {
  return {0.0, 0.5 * scene.duration_s, scene.duration_s};
}

LightNumbers numbers_of(const WorldLight& light, double size) {
  LightNumbers numbers{};
  std::size_t next = 0;
  const auto add = [&](const Vec3d& vector, double of_size) {
    for (int axis = 0; axis < 3; ++axis) numbers[next++] = bits_of(vector[axis], of_size);
  };
  numbers[next++] = static_cast<std::uint32_t>(light.type);
  numbers[next++] = bits_of(light.range_m, 0.0);
  numbers.back() = is_black(light) ? 1 : 0;  // not where another number is: of lights that shine it is 0
  add(light.position, size);
  if (light.type == LightType::spot) {
    add(light.direction, 1.0);
    numbers[next++] = bits_of(light.outer_cone_rad, 1.0);
  }
  if (light.type == LightType::box)
    for (const Vec3d& half_axis : light.half_axes_m) add(half_axis, light.range_m);
  return numbers;
}

}  // namespace

std::string light_digest(const Scene& scene) {
  std::string text;
  for (const double time_s : digest_times(scene)) {
    const std::vector<WorldLight> lights = world_lights(scene, time_s);
    const double size = size_of(lights);
    std::vector<LightNumbers> all;
    for (const WorldLight& light : lights) all.push_back(numbers_of(light, size));
    std::ranges::sort(all);
    text += std::to_string(all.size()) + ":";
    for (const LightNumbers& numbers : all)
      for (const std::uint32_t number : numbers) text += std::to_string(number) + " ";
  }
  constexpr std::size_t k_digits = 16;
  return sha256_hex(text).substr(0, k_digits);
}

bool is_dark(const WorldLight& light) {
  return is_black(light) || !(light.range_m > 0.0);
}

int count_dark_lights(const Scene& scene) {
  std::map<int, bool> always_dark;  // by index in the scene
  for (const double time_s : digest_times(scene))
    for (const WorldLight& light : world_lights(scene, time_s)) {
      if (light.type == LightType::box) continue;
      bool& is_always = always_dark.try_emplace(light.rig_index, true).first->second;
      is_always = is_always && is_dark(light);
    }
  return static_cast<int>(std::ranges::count_if(always_dark, [](const auto& light) { return light.second; }));
}

}  // namespace clusterbench::scene
