#include "scene/digests.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <mutex>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "core/sha256.h"

namespace clusterbench::scene {
namespace {

// Bits of single-precision numbers: of a light, or a part of a camera's.
using Numbers = std::array<std::uint32_t, 18>;
using State = std::vector<Numbers>;

double size_of(const std::vector<WorldLight>& lights) {
  double size = 0.0;
  for (const WorldLight& light : lights) {
    for (int axis = 0; axis < 3; ++axis) size = std::max(size, std::abs(light.position[axis]));
    if (std::isfinite(light.range_m)) size = std::max(size, light.range_m);
  }
  return size;
}

// The bits of the number in single precision. A number far below the roundoff of `size` counts as 0.
std::uint32_t bits_of(double value, double size) {
  if (!std::isfinite(value)) return std::bit_cast<std::uint32_t>(std::numeric_limits<float>::infinity());
  return std::abs(value) <= 0x1p-40 * size ? 0 : std::bit_cast<std::uint32_t>(static_cast<float>(value));
}

bool is_black(const WorldLight& light) {
  return light.type != LightType::box && !(light.luminous_intensity_cd > 0.0);
}

using Channels = std::vector<const Channel*>;

// Channels of these nodes and of all nodes above them.
Channels channels_of_nodes(const Scene& scene, const std::vector<int>& nodes) {
  std::vector<bool> is_followed(scene.nodes.size(), false);
  for (int node : nodes)
    for (; node >= 0 && !is_followed[static_cast<std::size_t>(node)];
         node = scene.nodes[static_cast<std::size_t>(node)].parent)
      is_followed[static_cast<std::size_t>(node)] = true;
  Channels found;
  for (const Channel& channel : scene.channels)
    if (is_followed[static_cast<std::size_t>(channel.node)]) found.push_back(&channel);
  return found;
}

Channels channels_of_lights(const Scene& scene) {
  std::vector<int> nodes;
  for (const Light& light : scene.lights) nodes.push_back(light.node);
  Channels found = channels_of_nodes(scene, nodes);
  for (const Channel& channel : scene.light_channels) found.push_back(&channel);
  return found;
}

Channels channels_of_camera(const Scene& scene, const Camera& camera) {
  Channels found = channels_of_nodes(scene, {camera.node});
  std::erase_if(found, [](const Channel* channel) { return channel->path == ChannelPath::visible; });
  for (const Channel& channel : scene.camera_channels)
    if (channel.definition == camera.definition) found.push_back(&channel);
  return found;
}

struct Moments {
  std::vector<double> times_s;  // ascending, at least one
  bool are_all = true;          // false: there may be changes between them
};

// Keys and the middles between them, where a cubic spline or a turn differs from a line. If these are too many, only
// some of them.
Moments moments_of(const Scene& scene, const Channels& channels) {
  constexpr std::size_t k_most_nodes = std::size_t{1} << 21, k_most_moments = 512, k_least_moments = 9;
  std::set<double> keys;
  for (const Channel* channel : channels) keys.insert(channel->times_s.begin(), channel->times_s.end());
  if (keys.empty()) return {{0.0}};
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

void add_state(const State& state, Sha256& digest) {
  digest.add(std::to_string(state.size()) + ":");
  std::array<char, 11 * std::tuple_size_v<Numbers>> text;  // ten digits and a space each
  for (const Numbers& numbers : state) {
    char* end = text.data();
    for (const std::uint32_t number : numbers) {
      end = std::to_chars(end, text.data() + text.size(), number).ptr;
      *end++ = ' ';
    }
    digest.add({text.data(), end});
  }
}

using StateAt = std::function<State(double time_s)>;

// The states at some moments.
std::vector<State> states_at(std::span<const double> times_s, const StateAt& state_at, int threads) {
  std::vector<State> states(times_s.size());
  parallel_ranges(states.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) states[i] = state_at(times_s[i]);
  });
  return states;
}

// The states that the channels give to a light or camera, at each moment.
void add_states(const Scene& scene, const Channels& channels, const StateAt& state_at, Sha256& digest,
                int threads = 1) {
  constexpr std::size_t k_most_lights_at_once = std::size_t{1} << 17, k_moments_of_thread = 8;
  const Moments moments = moments_of(scene, channels);
  State last = state_at(moments.times_s.front());
  for (int i = 0; i < 3; ++i) add_state(last, digest);  // as in older results for lights that never move
  const std::size_t at_once = std::clamp<std::size_t>(k_most_lights_at_once / std::max<std::size_t>(1, last.size()), 1,
                                                      k_moments_of_thread * static_cast<std::size_t>(threads));
  for (std::size_t begin = 1; begin < moments.times_s.size(); begin += at_once) {
    const std::span times_s = std::span(moments.times_s).subspan(begin);
    const auto some_s = times_s.first(std::min(at_once, times_s.size()));
    std::vector<State> states = states_at(some_s, state_at, threads);
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (states[i] == last) continue;
      digest.add("at " + std::to_string(bits_of(some_s[i], 0.0)) + " ");
      add_state(states[i], digest);
      last = std::move(states[i]);
    }
  }
  if (moments.are_all) return;
  for (const Channel* channel : channels) {
    std::string text = std::to_string(static_cast<int>(channel->path));
    for (const double time_s : channel->times_s) text += " " + std::to_string(bits_of(time_s, 0.0));
    for (const Vec4d& value : channel->values)
      for (int axis = 0; axis < 4; ++axis) text += " " + std::to_string(bits_of(value[axis], 0.0));
    digest.add(text);
  }
}

std::string first_digits(Sha256& digest) {
  constexpr std::size_t k_digits = 16;
  return digest.hex().substr(0, k_digits);
}

Numbers numbers_of(const WorldLight& light, double size) {
  Numbers numbers{};
  std::size_t next = 0;
  const auto add = [&](const Vec3d& vector, double of_size) {
    for (int axis = 0; axis < 3; ++axis) numbers[next++] = bits_of(vector[axis], of_size);
  };
  numbers[next++] = static_cast<std::uint32_t>(light.type);
  numbers[next++] = bits_of(light.range_m, 0.0);
  numbers.back() = is_black(light) ? 1 : 0;  // this slot is unused: 0 for lights that shine
  add(light.position, size);
  if (light.type == LightType::spot) {
    add(light.direction, 1.0);
    numbers[next++] = bits_of(light.outer_cone_rad, 1.0);
  }
  if (light.type == LightType::box)
    for (const Vec3d& half_axis : light.half_axes_m) add(half_axis, light.range_m);
  return numbers;
}

// Of all lights, in a canonical order.
State lights_at(const Scene& scene, double time_s) {
  const std::vector<WorldLight> lights = world_lights(scene, time_s);
  const double size = size_of(lights);
  State all;
  all.reserve(lights.size());
  for (const WorldLight& light : lights) all.push_back(numbers_of(light, size));
  std::ranges::sort(all);
  return all;
}

State camera_at(const Scene& scene, const Camera& camera, double time_s) {
  const CameraPose pose = camera_pose(scene, camera, time_s);
  const CameraProjection projection = projection_at(scene, camera, time_s);
  const double size = std::max({std::abs(pose.eye.x), std::abs(pose.eye.y), std::abs(pose.eye.z)});
  Numbers stand{}, lens{};
  std::size_t next = 0;
  for (int axis = 0; axis < 3; ++axis) {
    stand[next++] = bits_of(pose.eye[axis], size);
    for (int row = 0; row < 3; ++row) stand[next++] = bits_of(pose.view_from_world[axis][row], 1.0);
  }
  next = 0;
  lens[next++] = projection.orthographic ? 1 : 0;
  for (const double value : {projection.yfov_rad, projection.aspect_ratio.value_or(0.0), projection.xmag_m,
                             projection.ymag_m, projection.near_m, projection.far_m})
    lens[next++] = bits_of(value, 0.0);
  if (const auto& sides = projection.sides)
    for (const double side : {sides->left, sides->right, sides->bottom, sides->top}) lens[next++] = bits_of(side, 0.0);
  return {stand, lens};
}

}  // namespace

std::string light_digest(const Scene& scene, int threads) {
  Sha256 digest;
  add_states(
      scene, channels_of_lights(scene), [&](double time_s) { return lights_at(scene, time_s); }, digest, threads);
  if (const auto directionals = std::ranges::count(scene.lights, LightType::directional, &Light::type);
      directionals > 0)
    digest.add("directional " + std::to_string(directionals));
  return first_digits(digest);
}

std::string camera_digest(const Scene& scene, const Camera& camera) {
  Sha256 digest;
  add_states(
      scene, channels_of_camera(scene, camera), [&](double time_s) { return camera_at(scene, camera, time_s); },
      digest);
  return first_digits(digest);
}

bool lights_change(const Scene& scene) {
  return !channels_of_lights(scene).empty();
}

bool is_dark(const WorldLight& light) {
  return is_black(light) || !(light.range_m > 0.0);
}

DarkLights count_dark_lights(const Scene& scene, int threads) {
  struct AtAnyTime {
    bool is_assigned = false, shines = false, has_range = false;
  };
  std::vector<AtAnyTime> lights(scene.lights.size());
  const std::vector<double> times_s = moments_of(scene, channels_of_lights(scene)).times_s;
  std::mutex adding;
  parallel_ranges(times_s.size(), threads, [&](std::size_t begin, std::size_t end) {
    std::vector<AtAnyTime> some(lights.size());
    for (std::size_t i = begin; i < end; ++i)
      for (const WorldLight& light : world_lights(scene, times_s[i])) {
        if (light.type == LightType::box) continue;
        AtAnyTime& seen = some[static_cast<std::size_t>(light.rig_index)];
        seen.is_assigned = true;
        seen.shines = seen.shines || !is_dark(light);
        seen.has_range = seen.has_range || light.range_m > 0.0;
      }
    const std::lock_guard lock(adding);
    for (std::size_t light = 0; light < lights.size(); ++light) {
      AtAnyTime& seen = lights[light];
      seen = {seen.is_assigned || some[light].is_assigned, seen.shines || some[light].shines,
              seen.has_range || some[light].has_range};
    }
  });
  DarkLights dark;
  for (const AtAnyTime& seen : lights) {
    const bool is_dark = seen.is_assigned && !seen.shines;
    if (is_dark) ++dark.all;
    if (is_dark && !seen.has_range) ++dark.without_range;
  }
  return dark;
}

}  // namespace clusterbench::scene
