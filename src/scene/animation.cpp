#include "scene/animation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>

namespace clusterbench::scene {
namespace {

Vec4d unit_quaternion(const Vec4d& q) {
  const double length = glm::length(q);
  return length > 0.0 && std::isfinite(length) ? q / length : Vec4d(0.0, 0.0, 0.0, 1.0);
}

// The key's own value; a cubic spline stores it between the two tangents.
Vec4d key_value(const Channel& channel, std::size_t key) {
  return channel.interpolation == Interpolation::cubic_spline ? channel.values[3 * key + 1] : channel.values[key];
}

// Tangents are per second, so they are multiplied by the key interval.
Vec4d hermite(const Channel& channel, std::size_t key, double t, double interval_s) {
  const Vec4d& start = channel.values[3 * key + 1];
  const Vec4d& out_tangent = channel.values[3 * key + 2];
  const Vec4d& in_tangent = channel.values[3 * key + 3];
  const Vec4d& end = channel.values[3 * key + 4];
  const double t2 = t * t, t3 = t2 * t;
  return (2.0 * t3 - 3.0 * t2 + 1.0) * start + interval_s * (t3 - 2.0 * t2 + t) * out_tangent +
         (3.0 * t2 - 2.0 * t3) * end + interval_s * (t3 - t2) * in_tangent;
}

Vec4d between_keys(const Channel& channel, std::size_t key, double time_s) {
  const double interval_s = channel.times_s[key + 1] - channel.times_s[key];
  const double t = (time_s - channel.times_s[key]) / interval_s;
  switch (channel.interpolation) {
    case Interpolation::step:
      return key_value(channel, key);
    case Interpolation::cubic_spline:
      return hermite(channel, key, t, interval_s);
    case Interpolation::linear:
      break;
  }
  const Vec4d a = key_value(channel, key), b = key_value(channel, key + 1);
  if (channel.path == ChannelPath::rotation) return slerp(unit_quaternion(a), unit_quaternion(b), t);
  return (1.0 - t) * a + t * b;
}

}  // namespace

Vec4d slerp(const Vec4d& a, const Vec4d& b, double t) {
  const bool far_side = glm::dot(a, b) < 0.0;
  const Vec4d near_b = far_side ? -b : b;  // q and -q are the same rotation: use the nearer one
  // sin(angle) from the chord keeps the digits that acos(cosine) loses.
  const double angle = 2.0 * std::atan2(glm::length(near_b - a), glm::length(near_b + a));
  const double sine = std::sin(angle);
  if (sine < 1e-12) return unit_quaternion((1.0 - t) * a + t * near_b);
  return unit_quaternion((std::sin((1.0 - t) * angle) / sine) * a + (std::sin(t * angle) / sine) * near_b);
}

std::vector<bool> moving_nodes(const Scene& scene) {
  std::vector<bool> moving(scene.nodes.size(), false);
  for (const Channel& channel : scene.channels)
    if (channel.path != ChannelPath::visible) moving[static_cast<std::size_t>(channel.node)] = true;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i)
    if (const int parent = scene.nodes[i].parent; parent >= 0 && moving[static_cast<std::size_t>(parent)])
      moving[i] = true;
  return moving;
}

Vec4d sample(const Channel& channel, double time_s) {
  assert(!channel.times_s.empty());
  const auto& times = channel.times_s;
  const auto after = std::upper_bound(times.begin(), times.end(), time_s);
  Vec4d value;
  if (after == times.begin()) {
    value = key_value(channel, 0);
  } else if (after == times.end()) {
    value = key_value(channel, times.size() - 1);
  } else {
    value = between_keys(channel, static_cast<std::size_t>(after - times.begin()) - 1, time_s);
  }
  return channel.path == ChannelPath::rotation ? unit_quaternion(value) : value;
}

}  // namespace clusterbench::scene
