#include "scene/gltf_scene/gltf_keys.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "scene/gltf_scene/gltf_checked.h"

namespace clusterbench::scene {
namespace {

void check_times_format(const AccessorReader& reader, const JsonLocation& sampler, std::size_t accessor) {
  const JsonLocation input = sampler.at("input"), location = reader.location(accessor);
  const AccessorHead head = reader.head(accessor);
  if (head.type != "SCALAR" || head.component != Component::f32) {
    input.refuse("key times must be SCALAR floats, accessor " + std::to_string(accessor) + " is not");
  }
  for (const char* bound : {"min", "max"}) {
    if (location.has(bound)) {
      location.at(bound).numbers(1);
    } else {
      location.warn(std::string("'") + bound + "' is missing, where glTF asks for it at key times; the times are read");
    }
  }
}

constexpr const char* k_moves_neither = "; it moves neither light nor camera";

// nullopt if keys are out of order and move neither light nor camera.
std::optional<std::vector<double>> read_times(AccessorReader& reader, const JsonLocation& sampler, std::size_t accessor,
                                              KeysMove moved) {
  const JsonLocation input = sampler.at("input");
  const bool is_strict = moved == KeysMove::lights_or_cameras;
  std::vector<double> times_s = reader.numbers(accessor, 1);
  bool has_equal = false;
  for (std::size_t i = 1; i < times_s.size(); ++i) {
    if (times_s[i] > times_s[i - 1]) continue;
    const std::string fault = "key " + std::to_string(i) + " is at " + std::to_string(times_s[i]) +
                              " s, the one before at " + std::to_string(times_s[i - 1]) + " s";
    if (is_strict) input.refuse("key times must ascend: " + fault);
    if (times_s[i] < times_s[i - 1]) {
      input.warn("key times that do not ascend: " + fault + k_moves_neither + ", so the channel is ignored");
      return std::nullopt;
    }
    if (!std::exchange(has_equal, true))
      input.warn("key times must ascend: " + fault + k_moves_neither + ", so the later of the two holds");
  }
  if (times_s.front() < 0.0) {
    const std::string fault = "the first key time is " + std::to_string(times_s.front()) + ", 0 or more is needed";
    if (is_strict) input.refuse(fault);
    input.warn(fault + k_moves_neither + ", so it is read as it is");
  }
  return times_s;
}

std::size_t components_of(ChannelPath path) {
  switch (path) {
    case ChannelPath::rotation:
      return 4;
    case ChannelPath::translation:
    case ChannelPath::scale:
    case ChannelPath::color:
      return 3;
    default:
      return 1;
  }
}

void check_format(const JsonLocation& output, const AccessorHead& head, ChannelPath path, bool is_pointer) {
  const bool number = head.component == Component::f32 || (head.normalized && head.component != Component::u32);
  const std::size_t components = components_of(path);
  if (path == ChannelPath::visible) {
    if (head.type != "SCALAR" || head.component != Component::u8 || head.normalized)
      output.refuse("visibility must be SCALAR unsigned bytes, 0 or 1");
  } else if (path == ChannelPath::rotation) {
    if (head.type != "VEC4" || !number) output.refuse("rotations must be VEC4 floats or normalized integers");
  } else if (components == 3) {
    if (head.type != "VEC3" || !(is_pointer ? number : head.component == Component::f32))
      output.refuse(path == ChannelPath::color ? "colours must be VEC3 floats or normalized integers"
                                               : "translations and scales must be VEC3 floats");
  } else if (head.type != "SCALAR" || !number) {
    output.refuse("a single number must be SCALAR floats or normalized integers");
  }
}

// Checks the allowed values of a light's or projection's property; a node's may be anything. A projection is checked as
// a whole later.
void check_allowed(const JsonLocation& output, const Channel& channel) {
  const bool cubic = channel.interpolation == Interpolation::cubic_spline;
  const bool angle = channel.path == ChannelPath::inner_cone || channel.path == ChannelPath::outer_cone;
  constexpr double k_widest = 1.57079632679489661923 + k_angle_slack_rad;
  for (std::size_t i = cubic ? 1 : 0; i < channel.values.size(); i += cubic ? 3 : 1) {
    const Vec4d& value = channel.values[i];
    const double least = std::min({value.x, value.y, value.z});
    if (least < 0.0 || (angle && value.x > k_widest))
      output.refuse("found " + std::to_string(least) + " at element " + std::to_string(i) +
                    (angle ? ", 0 to pi/2 is needed" : ", 0 or more is needed"));
  }
}

void check_unit(const JsonLocation& output, const Channel& channel) {
  const bool cubic = channel.interpolation == Interpolation::cubic_spline;
  for (std::size_t i = cubic ? 1 : 0; i < channel.values.size(); i += cubic ? 3 : 1) {
    const double length = glm::length(channel.values[i]);
    if (std::abs(length - 1.0) > k_unit_tolerance) {
      output.refuse("a rotation must have length 1, found " + std::to_string(length) + " at element " +
                    std::to_string(i));
    }
  }
}

}  // namespace

std::optional<Channel> read_keys(AccessorReader& reader, const JsonLocation& sampler, std::size_t input,
                                 std::size_t output, ChannelPath path, bool is_pointer, Interpolation interpolation,
                                 KeysMove moved) {
  check_times_format(reader, sampler, input);
  const AccessorHead head = reader.head(output);
  check_format(sampler.at("output"), head, path, is_pointer);
  const bool cubic = interpolation == Interpolation::cubic_spline;
  if (path == ChannelPath::visible && interpolation != Interpolation::step)
    sampler.refuse("visibility cannot lie between two values; the interpolation must be STEP");
  const std::size_t keys = reader.head(input).count, needed = keys * (cubic ? 3 : 1);
  if (cubic && keys < 2) sampler.at("input").refuse("a cubic spline needs two keys or more");
  if (head.count != needed) {
    sampler.at("output").refuse("found " + std::to_string(head.count) + " values, " + std::to_string(needed) +
                                " are needed for " + std::to_string(keys) + " keys");
  }
  const auto without_data = [&] {
    sampler.warn("its accessors hold no data; the channel is ignored");
    return std::nullopt;
  };
  if (keys == 0) return without_data();

  Channel channel;
  channel.path = path;
  channel.interpolation = interpolation;
  const std::size_t components = components_of(path);
  const std::vector<double> numbers = reader.numbers(output, components);
  channel.values.reserve(needed);
  for (std::size_t i = 0; i < numbers.size(); i += components) {
    Vec4d value{0.0};
    for (std::size_t k = 0; k < components; ++k) value[static_cast<int>(k)] = numbers[i + k];
    channel.values.push_back(value);
  }
  if (path >= ChannelPath::range && path <= ChannelPath::outer_cone) check_allowed(sampler.at("output"), channel);
  const bool rotation = path == ChannelPath::rotation, turns = rotation && reader.has_data(output);
  if (turns) check_unit(sampler.at("output"), channel);
  if (keys > 1 && !reader.has_data(input)) return without_data();
  std::optional<std::vector<double>> times_s = read_times(reader, sampler, input, moved);
  if (!times_s) return std::nullopt;
  if (rotation && !turns) return without_data();
  channel.times_s = std::move(*times_s);
  return channel;
}

}  // namespace clusterbench::scene
