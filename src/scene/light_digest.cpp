#include "scene/light_digest.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <utility>
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

bool are_of_lights(const Channel& channel, const std::vector<bool>& holds_lights) {
  return channel.node < 0 || holds_lights[static_cast<std::size_t>(channel.node)];
}

// Nodes with a light of their own or below them.
std::vector<bool> nodes_with_lights(const Scene& scene) {
  std::vector<bool> holds(scene.nodes.size(), false);
  for (const Light& light : scene.lights) holds[static_cast<std::size_t>(light.node)] = true;
  for (std::size_t i = scene.nodes.size(); i-- > 0;)
    if (const int parent = scene.nodes[i].parent; parent >= 0 && holds[i]) holds[static_cast<std::size_t>(parent)] = true;
  return holds;
}

// Channels that lights follow.
std::vector<const Channel*> channels_of_lights(const Scene& scene) {
  const std::vector<bool> holds_lights = nodes_with_lights(scene);
  std::vector<const Channel*> found;
  for (const Channel& channel : scene.channels)
    if (are_of_lights(channel, holds_lights)) found.push_back(&channel);
  for (const Channel& channel : scene.light_channels) found.push_back(&channel);
  return found;
}

struct Moments {
  std::vector<double> times_s;  // ascending
  bool are_all = true;          // false: lights may be others between them
};

// Keys of what lights follow, and the middles between them, where a cubic spline or a turn differs from a line. Of more
// than can be asked for in a moment some.
Moments moments_of(const Scene& scene) {
  constexpr std::size_t k_most_nodes = std::size_t{1} << 21, k_most_moments = 512, k_least_moments = 9;
  std::set<double> keys{0.0};
  for (const Channel* channel : channels_of_lights(scene)) keys.insert(channel->times_s.begin(), channel->times_s.end());
  Moments all;
  for (const double key : keys) {
    if (!all.times_s.empty()) all.times_s.push_back(0.5 * (all.times_s.back() + key));
    all.times_s.push_back(key);
  }
  const std::size_t most =
      std::clamp(k_most_nodes / std::max<std::size_t>(scene.nodes.size(), 1), k_least_moments, k_most_moments);
  if (all.times_s.size() <= most) return all;
  Moments some{{}, false};
  for (std::size_t i = 0; i < most; ++i) some.times_s.push_back(all.times_s[i * (all.times_s.size() - 1) / (most - 1)]);
  return some;
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

// Of all lights at one time, in an order of their own.
std::string state_text(const Scene& scene, double time_s) {
  const std::vector<WorldLight> lights = world_lights(scene, time_s);
  const double size = size_of(lights);
  std::vector<LightNumbers> all;
  for (const WorldLight& light : lights) all.push_back(numbers_of(light, size));
  std::ranges::sort(all);
  std::string text = std::to_string(all.size()) + ":";
  for (const LightNumbers& numbers : all)
    for (const std::uint32_t number : numbers) text += std::to_string(number) + " ";
  return text;
}

// All keys, where only some of them were asked for.
void add_channels(const Scene& scene, Sha256& digest) {
  for (const Channel* channel : channels_of_lights(scene)) {
    std::string text = std::to_string(static_cast<int>(channel->path));
    for (const double time_s : channel->times_s) text += " " + std::to_string(bits_of(time_s, 0.0));
    for (const Vec4d& value : channel->values)
      for (int axis = 0; axis < 4; ++axis) text += " " + std::to_string(bits_of(value[axis], 0.0));
    digest.add(text);
  }
}

}  // namespace

std::string light_digest(const Scene& scene) {
  const Moments moments = moments_of(scene);
  const std::string first = state_text(scene, moments.times_s.front());
  Sha256 digest;
  std::string last = first;
  digest.add(first + first + first);  // as older results have it of lights that stand still
  for (const double time_s : moments.times_s) {
    std::string now = state_text(scene, time_s);
    if (now == last) continue;
    digest.add("at " + std::to_string(bits_of(time_s, 0.0)) + " " + now);
    last = std::move(now);
  }
  if (!moments.are_all) add_channels(scene, digest);
  if (const auto directionals = std::ranges::count(scene.lights, LightType::directional, &Light::type); directionals > 0)
    digest.add("directional " + std::to_string(directionals));
  constexpr std::size_t k_digits = 16;
  return digest.hex().substr(0, k_digits);
}

bool is_dark(const WorldLight& light) {
  return is_black(light) || !(light.range_m > 0.0);
}

int count_dark_lights(const Scene& scene) {
  std::map<int, bool> always_dark;  // by index in the scene
  for (const double time_s : moments_of(scene).times_s)
    for (const WorldLight& light : world_lights(scene, time_s)) {
      if (light.type == LightType::box) continue;
      bool& is_always = always_dark.try_emplace(light.rig_index, true).first->second;
      is_always = is_always && is_dark(light);
    }
  return static_cast<int>(std::ranges::count_if(always_dark, [](const auto& light) { return light.second; }));
}

}  // namespace clusterbench::scene
