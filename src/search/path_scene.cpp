#include "search/path_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "run/cases/path_frames.h"

namespace clusterbench::search {
namespace {

using scene::Channel;
using scene::ChannelPath;

constexpr int k_camera_node = 0;
// Written for a light without end. The loader reads any range above 1e15 m as endless.
constexpr double k_endless_m = 1e30;

// A channel with a key for each frame, at 0 s, 1 s and so on.
Channel step_channel(std::size_t frames, ChannelPath path) {
  Channel channel;
  channel.path = path;
  channel.interpolation = scene::Interpolation::step;
  channel.values.resize(frames, path == ChannelPath::rotation ? Vec4d(0.0, 0.0, 0.0, 1.0) : Vec4d(0.0));
  for (std::size_t i = 0; i < frames; ++i) channel.times_s.push_back(static_cast<double>(i));
  return channel;
}

Channel node_channel(std::size_t frames, ChannelPath path, int node) {
  Channel channel = step_channel(frames, path);
  channel.node = node;
  return channel;
}

Channel light_channel(std::size_t frames, ChannelPath path, int definition) {
  Channel channel = step_channel(frames, path);
  channel.definition = definition;
  return channel;
}

int node_of(std::size_t light) {
  return static_cast<int>(light) + 1;
}

}  // namespace

Vec3d rounded_to_float(const Vec3d& value) {
  return {rounded_to_float(value.x), rounded_to_float(value.y), rounded_to_float(value.z)};
}
Vec4d rounded_to_float(const Vec4d& value) {
  return {rounded_to_float(value.x), rounded_to_float(value.y), rounded_to_float(value.z), rounded_to_float(value.w)};
}

LightRig::LightRig(const scene::Scene& scene, const scene::CameraPath& path, const std::vector<double>& extra_ranges_m,
                   bool may_move) {
  std::vector<std::size_t> index(scene.lights.size());
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    if (scene.lights[i].type == scene::LightType::directional) continue;
    index[i] = lights_.size();
    lights_.push_back(scene.lights[i]);
  }
  own_ = lights_.size();
  for (const int frame : run::evenly_spaced(k_most_moments, static_cast<int>(path.shots.size()))) {
    moment_frames_.push_back(static_cast<std::size_t>(frame));
    std::vector<State>& states = states_.emplace_back(own_);
    for (const scene::WorldLight& light : scene::world_lights(scene, path.shots[moment_frames_.back()].time_s)) {
      State& state = states[index[static_cast<std::size_t>(light.rig_index)]];
      state.position = light.position;
      state.range_m = std::isfinite(light.range_m) ? light.range_m : k_endless_m;
      if (light.type == scene::LightType::spot) {
        state.rotation = scene::rotation_towards(light.direction);
        state.outer_cone_rad = light.outer_cone_rad;
      }
    }
  }
  find_changes(may_move);
  round_changing();
  for (std::size_t i = 0; i < extra_ranges_m.size(); ++i) {
    scene::Light& light = lights_.emplace_back();
    light.name = "extra light " + std::to_string(i + 1);
    light.range_m = extra_ranges_m[i];
  }
}

void LightRig::find_changes(bool may_move) {
  changes_.assign(own_, {may_move, false, false, false});
  bool is_any = false;
  for (const std::vector<State>& states : states_)
    for (std::size_t i = 0; i < own_; ++i) {
      const State &first = states_.front()[i], &now = states[i];
      const Changes here{now.position != first.position, now.rotation != first.rotation, now.range_m != first.range_m,
                         now.outer_cone_rad != first.outer_cone_rad};
      changes_[i] = {changes_[i].position || here.position, changes_[i].rotation || here.rotation,
                     changes_[i].range || here.range, changes_[i].cone || here.cone};
      is_any = is_any || here.position || here.rotation || here.range || here.cone;
    }
  if (is_any) return;
  states_.resize(1);
  moment_frames_.resize(1);
}

void LightRig::round_changing() {
  for (std::vector<State>& states : states_)
    for (std::size_t i = 0; i < own_; ++i) {
      if (changes_[i].position) states[i].position = rounded_to_float(states[i].position);
      if (changes_[i].rotation) states[i].rotation = rounded_to_float(states[i].rotation);
      if (changes_[i].range) states[i].range_m = rounded_to_float(states[i].range_m);
      if (changes_[i].cone) states[i].outer_cone_rad = rounded_to_float(states[i].outer_cone_rad);
    }
}

std::size_t LightRig::moment_of(std::size_t frame) const {
  const auto after = std::ranges::upper_bound(moment_frames_, frame);
  return after == moment_frames_.begin() ? 0 : static_cast<std::size_t>(after - moment_frames_.begin()) - 1;
}

scene::Scene LightRig::scene(std::size_t frames, const scene::CameraProjection& projection) const {
  scene::Scene out;
  out.name = "worst-case";
  out.nodes.resize(lights_.size() + 1);
  out.nodes[k_camera_node].name = "worst-case";
  scene::Camera& camera = out.cameras.emplace_back();
  camera.name = "worst-case";
  camera.node = k_camera_node;
  camera.definition = 0;
  camera.animated = true;
  camera.projection = projection;
  out.channels.push_back(node_channel(frames, ChannelPath::translation, k_camera_node));
  out.channels.push_back(node_channel(frames, ChannelPath::rotation, k_camera_node));
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    const int node = node_of(i), definition = static_cast<int>(i);
    scene::Light light = lights_[i];
    light.node = node;
    light.definition = definition;
    const bool is_extra = i >= own_;
    const Changes changes = is_extra ? Changes{true, false, false, false} : changes_[i];
    if (!is_extra) {
      const State& state = states_.front()[i];
      out.nodes[i + 1].translation = state.position;
      if (light.type == scene::LightType::spot) out.nodes[i + 1].rotation = state.rotation;
      light.range_m = state.range_m;
      if (!changes.cone && light.type == scene::LightType::spot) light.outer_cone_rad = state.outer_cone_rad;
      light.inner_cone_rad = std::min(light.inner_cone_rad, light.outer_cone_rad);
    }
    light.range_given_m = light.range_m;
    out.nodes[i + 1].name = light.name;
    if (changes.position) out.channels.push_back(node_channel(frames, ChannelPath::translation, node));
    if (changes.rotation) out.channels.push_back(node_channel(frames, ChannelPath::rotation, node));
    if (changes.range) out.light_channels.push_back(light_channel(frames, ChannelPath::range, definition));
    if (changes.cone) out.light_channels.push_back(light_channel(frames, ChannelPath::outer_cone, definition));
    out.lights.push_back(std::move(light));
  }
  out.duration_s = static_cast<double>(frames - 1);
  return out;
}

void LightRig::set_frame(scene::Scene& scene, std::size_t frame, const FrameChoice& choice) const {
  const std::vector<State>& states = states_[choice.moment];
  const auto position_of = [&](std::size_t light) {
    if (light >= own_) return choice.extra_lights[light - own_];
    const auto moved = std::ranges::lower_bound(choice.moved, light, {}, [](const auto& entry) { return entry.first; });
    const bool is_moved = moved != choice.moved.end() && moved->first == light;
    return is_moved ? moved->second : states[light].position;
  };
  for (Channel& channel : scene.channels) {
    const bool is_position = channel.path == ChannelPath::translation;
    if (channel.node == k_camera_node) {
      channel.values[frame] = is_position ? Vec4d(choice.eye, 0.0) : choice.rotation;
      continue;
    }
    const auto light = static_cast<std::size_t>(channel.node) - 1;
    channel.values[frame] = is_position ? Vec4d(position_of(light), 0.0) : states[light].rotation;
  }
  for (Channel& channel : scene.light_channels) {
    const State& state = states[static_cast<std::size_t>(channel.definition)];
    channel.values[frame].x = channel.path == ChannelPath::range ? state.range_m : state.outer_cone_rad;
  }
}

scene::CameraPath path_of(const scene::Scene& path_scene, const scene::PathRequest& request) {
  scene::PathRequest each = request;
  each.camera = "";
  each.choice = scene::FrameChoice::keys;
  return std::move(scene::camera_paths(path_scene, each).front());
}

}  // namespace clusterbench::search
