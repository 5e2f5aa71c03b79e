#include "scene/gltf_scene/gltf_pointers.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace clusterbench::scene {
namespace {

struct Known {
  const char *before, *after;  // of the index
  TargetKind kind;
  ChannelPath path;
};

constexpr const char* k_node = "/nodes/";
constexpr const char* k_camera = "/cameras/";
constexpr const char* k_light = "/extensions/KHR_lights_punctual/lights/";

constexpr std::array k_known = {
    Known{k_node, "/translation", TargetKind::node, ChannelPath::translation},
    Known{k_node, "/rotation", TargetKind::node, ChannelPath::rotation},
    Known{k_node, "/scale", TargetKind::node, ChannelPath::scale},
    Known{k_node, "/extensions/KHR_node_visibility/visible", TargetKind::node, ChannelPath::visible},
    Known{k_light, "/range", TargetKind::light, ChannelPath::range},
    Known{k_light, "/intensity", TargetKind::light, ChannelPath::intensity},
    Known{k_light, "/color", TargetKind::light, ChannelPath::color},
    Known{k_light, "/spot/innerConeAngle", TargetKind::light, ChannelPath::inner_cone},
    Known{k_light, "/spot/outerConeAngle", TargetKind::light, ChannelPath::outer_cone},
    Known{k_camera, "/perspective/yfov", TargetKind::camera, ChannelPath::yfov},
    Known{k_camera, "/perspective/aspectRatio", TargetKind::camera, ChannelPath::aspect_ratio},
    Known{k_camera, "/perspective/znear", TargetKind::camera, ChannelPath::near},
    Known{k_camera, "/perspective/zfar", TargetKind::camera, ChannelPath::far},
    Known{k_camera, "/orthographic/xmag", TargetKind::camera, ChannelPath::xmag},
    Known{k_camera, "/orthographic/ymag", TargetKind::camera, ChannelPath::ymag},
    Known{k_camera, "/orthographic/znear", TargetKind::camera, ChannelPath::near},
    Known{k_camera, "/orthographic/zfar", TargetKind::camera, ChannelPath::far},
};

// Removes an index from the front of `rest`.
std::optional<std::size_t> removed_index(std::string_view& rest) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), index);
  if (error != std::errc()) return std::nullopt;
  rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
  return index;
}

}  // namespace

std::optional<Target> target_of(const std::string& pointer) {
  for (const Known& known : k_known) {
    std::string_view rest = pointer;
    if (!rest.starts_with(known.before)) continue;
    rest.remove_prefix(std::string_view(known.before).size());
    const auto index = removed_index(rest);
    if (index && rest == known.after) return Target{known.kind, *index, known.path};
  }
  return std::nullopt;
}

bool moves_only_appearance(const std::string& pointer) {
  constexpr std::array k_appearance = {"/materials/", "/textures/", "/images/", "/samplers/", "/meshes/"};
  if (std::any_of(k_appearance.begin(), k_appearance.end(),
                  [&](const char* prefix) { return pointer.starts_with(prefix); }))
    return true;
  std::string_view rest = pointer;
  if (!rest.starts_with(k_node)) return false;
  rest.remove_prefix(std::string_view(k_node).size());
  return removed_index(rest) && (rest == "/weights" || rest.starts_with("/weights/"));
}

}  // namespace clusterbench::scene
