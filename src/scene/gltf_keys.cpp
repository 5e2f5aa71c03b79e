#include "scene/gltf_keys.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "scene/gltf_checked.h"

namespace clusterbench::scene {
namespace {

void check_times_format(const AccessorReader& reader, const Place& sampler, std::size_t accessor) {
  const Place input = sampler.at("input"), place = reader.place(accessor);
  const AccessorHead head = reader.head(accessor);
  if (head.type != "SCALAR" || head.component != Component::f32) {
    input.refuse("key times must be SCALAR floats, accessor " + std::to_string(accessor) + " is not");
  }
  for (const char* bound : {"min", "max"}) {
    if (!place.has(bound)) place.refuse(std::string("'") + bound + "' is missing; glTF asks for it at key times");
    place.at(bound).numbers(1);
  }
}

std::vector<double> read_times(AccessorReader& reader, const Place& sampler, std::size_t accessor) {
  const Place input = sampler.at("input");
  std::vector<double> times_s = reader.numbers(accessor, 1);
  if (times_s.front() < 0.0)
    input.refuse("the first key time is " + std::to_string(times_s.front()) + ", 0 or more is needed");
  for (std::size_t i = 1; i < times_s.size(); ++i) {
    if (times_s[i] <= times_s[i - 1]) {
      input.refuse("key times must ascend: key " + std::to_string(i) + " is at " + std::to_string(times_s[i]) +
                   " s, the one before at " + std::to_string(times_s[i - 1]) + " s");
    }
  }
  return times_s;
}

void check_format(const Place& output, const AccessorHead& head, ChannelPath path) {
  if (path == ChannelPath::rotation) {
    const bool number = head.component == Component::f32 || (head.normalized && head.component != Component::u32);
    if (head.type != "VEC4" || !number) output.refuse("rotations must be VEC4 floats or normalized integers");
  } else if (head.type != "VEC3" || head.component != Component::f32) {
    output.refuse("translations and scales must be VEC3 floats");
  }
}

void check_unit(const Place& output, const Channel& channel) {
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

std::optional<Channel> read_keys(AccessorReader& reader, const Place& sampler, std::size_t input, std::size_t output,
                                 ChannelPath path, Interpolation interpolation) {
  check_times_format(reader, sampler, input);
  const AccessorHead head = reader.head(output);
  check_format(sampler.at("output"), head, path);
  const bool cubic = interpolation == Interpolation::cubic_spline;
  const std::size_t keys = reader.head(input).count, needed = keys * (cubic ? 3 : 1);
  if (cubic && keys < 2) sampler.at("input").refuse("a cubic spline needs two keys or more");
  if (head.count != needed) {
    sampler.at("output").refuse("found " + std::to_string(head.count) + " values, " + std::to_string(needed) +
                                " are needed for " + std::to_string(keys) + " keys");
  }

  Channel channel;
  channel.path = path;
  channel.interpolation = interpolation;
  const std::size_t components = path == ChannelPath::rotation ? 4 : 3;
  const std::vector<double> numbers = reader.numbers(output, components);
  channel.values.reserve(needed);
  for (std::size_t i = 0; i < numbers.size(); i += components) {
    channel.values.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2], components == 4 ? numbers[i + 3] : 0.0);
  }
  const bool rotation = path == ChannelPath::rotation, turns = rotation && reader.has_data(output);
  if (turns) check_unit(sampler.at("output"), channel);
  if (keys > 1 && !reader.has_data(input)) return std::nullopt;
  channel.times_s = read_times(reader, sampler, input);
  if (rotation && !turns) return std::nullopt;
  return channel;
}

}  // namespace clusterbench::scene
