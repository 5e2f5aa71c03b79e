#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "scene/gltf_scene/gltf_checked.h"
#include "scene/gltf_scene/gltf_pointers.h"

namespace clusterbench::scene {
namespace {

using nlohmann::json;

// The parts of the document that channels refer to.
struct Document {
  const JsonLocation& root;
  const LoadedScene& loaded;
  const std::vector<std::optional<LightType>>& lights;  // checked
  const std::vector<std::optional<Camera>>& cameras;
  bool requires_pointers;
};

json checked_sampler(const JsonLocation& root, const JsonLocation& sampler) {
  sampler.expect_object();
  const std::size_t accessors = count_of(root, "accessors");
  json out = {{"input", sampler.at("input").index(accessors, "accessor")},
              {"output", sampler.at("output").index(accessors, "accessor")},
              {"interpolation", "LINEAR"}};
  if (sampler.has("interpolation")) out["interpolation"] = sampler.at("interpolation").text();
  const std::string interpolation = out["interpolation"].get<std::string>();
  if (interpolation != "LINEAR" && interpolation != "STEP" && interpolation != "CUBICSPLINE") {
    sampler.at("interpolation").refuse("found '" + interpolation + "', LINEAR, STEP or CUBICSPLINE is needed");
  }
  return out;
}

// The target of a channel with a core path: a node.
std::optional<Target> core_target(const JsonLocation& target, const std::string& path) {
  const auto known = target_of("/nodes/0/" + path);
  if (!known) {
    target.at("path").warn("'" + path + "' moves no node and is ignored");
  } else if (!target.has("node")) {
    target.warn("names no node and is ignored");
  } else {
    return Target{TargetKind::node, target.at("node").whole(), known->path};
  }
  return std::nullopt;
}

// A file that requires pointers cannot be shown without them.
void ignore_pointer(const Document& document, const JsonLocation& location, const std::string& message) {
  if (document.requires_pointers) location.refuse(message + "; the file requires " + k_pointers);
  location.warn(message + " and is ignored");
}

std::optional<Target> pointer_target(const Document& document, const JsonLocation& target) {
  if (!target.has("extensions") || !target.at("extensions").has(k_pointers)) {
    ignore_pointer(document, target, "'pointer' without a pointer in extensions/KHR_animation_pointer moves nothing");
    return std::nullopt;
  }
  const JsonLocation location = target.at("extensions").at(k_pointers).at("pointer");
  const std::string& pointer = location.text();
  if (const auto known = target_of(pointer)) {
    const std::size_t there = known->kind == TargetKind::light    ? document.lights.size()
                              : known->kind == TargetKind::camera ? document.cameras.size()
                                                                  : document.loaded.nodes.size();
    if (known->index >= there) location.refuse("'" + pointer + "' leads nowhere: there are " + std::to_string(there));
    return known;
  }
  if (moves_only_appearance(pointer)) {
    location.warn("a pointer to materials, textures, meshes or weights moves neither light nor camera and is ignored");
  } else {
    ignore_pointer(document, location, "the pointer '" + pointer + "' is not known");
  }
  return std::nullopt;
}

const char* name_of(ChannelPath path) {
  constexpr const char* k_names[] = {"translation", "rotation", "scale",          "visible",        "range",
                                     "intensity",   "color",    "innerConeAngle", "outerConeAngle", "yfov",
                                     "aspectRatio", "znear",    "zfar",           "xmag",           "ymag"};
  return k_names[static_cast<int>(path)];
}

void check_target(const JsonLocation& root, const JsonLocation& target, const Target& moved) {
  if (moved.kind != TargetKind::node || moved.path == ChannelPath::visible ||
      !root.at("nodes").at(moved.index).has("matrix"))
    return;
  target.refuse("node " + std::to_string(moved.index) +
                " has a matrix; only translation, rotation and scale can be animated");
}

// Lights have a range and angles, cameras an angle or a size, depending on their kind.
bool has_property(const Document& document, const Target& moved) {
  if (moved.kind == TargetKind::node) return true;
  const ChannelPath path = moved.path;
  if (moved.kind == TargetKind::light) {
    const std::optional<LightType> type = document.lights[moved.index];
    if (path == ChannelPath::inner_cone || path == ChannelPath::outer_cone) return type == LightType::spot;
    return path == ChannelPath::range ? type == LightType::point || type == LightType::spot : type.has_value();
  }
  const std::optional<Camera>& camera = document.cameras[moved.index];
  if (path == ChannelPath::yfov || path == ChannelPath::aspect_ratio) return camera && !camera->projection.orthographic;
  if (path == ChannelPath::xmag || path == ChannelPath::ymag) return camera && camera->projection.orthographic;
  return camera.has_value();
}

// null for a channel that moves nothing that is loaded.
json checked_channel(const Document& document, const JsonLocation& channel, std::size_t samplers) {
  const std::size_t sampler = channel.at("sampler").index(samplers, "sampler");
  const JsonLocation target = channel.at("target");
  const std::string& path = target.at("path").text();
  if (target.has("node")) target.at("node").index(document.loaded.nodes.size(), "node");
  const std::optional<Target> moved = path == "pointer" ? pointer_target(document, target) : core_target(target, path);
  if (!moved) return json(nullptr);
  if (moved->kind == TargetKind::node && !document.loaded.nodes[moved->index]) return json(nullptr);
  check_target(document.root, target, *moved);
  if (!has_property(document, *moved)) {
    target.warn((moved->kind == TargetKind::light ? "light " : "camera ") + std::to_string(moved->index) + " has no " +
                name_of(moved->path) + "; the channel is ignored");
    return json(nullptr);
  }
  return {{"sampler", sampler},    {"is_pointer", path == "pointer"},       {"kind", static_cast<int>(moved->kind)},
          {"index", moved->index}, {"path", static_cast<int>(moved->path)}, {"name", name_of(moved->path)}};
}

json checked_animation(const Document& document, const JsonLocation& animation) {
  const JsonLocation samplers = animation.at("samplers"), channels = animation.at("channels");
  const std::size_t sampler_count = samplers.elements(), channel_count = channels.elements();
  json out = {{"samplers", json::array()}, {"channels", json::array()}};
  for (std::size_t i = 0; i < sampler_count; ++i)
    out["samplers"].push_back(checked_sampler(document.root, samplers.at(i)));
  std::set<std::tuple<int, std::size_t, int>> targets;
  for (std::size_t i = 0; i < channel_count; ++i) {
    json channel = checked_channel(document, channels.at(i), sampler_count);
    if (channel.is_null()) continue;
    const std::tuple target(channel["kind"].get<int>(), channel["index"].get<std::size_t>(),
                            channel["path"].get<int>());
    if (!targets.insert(target).second) {
      channels.at(i).at("target").refuse("an earlier channel of this animation moves the same");
    }
    channel["channel"] = i;
    out["channels"].push_back(std::move(channel));
  }
  return out;
}

}  // namespace

json checked_animations(const JsonLocation& root, const LoadedScene& loaded, const CheckedDocument& checked,
                        std::optional<std::size_t> animation) {
  json out = json::array();
  const Document document{root, loaded, checked.lights, checked.cameras, is_required(root, k_pointers)};
  const std::size_t count = root.has("animations") ? root.at("animations").elements() : 0;
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_read = !animation || *animation == i;
    out.push_back(is_read ? checked_animation(document, root.at("animations").at(i))
                          : json{{"channels", json::array()}});
  }
  return out;
}

}  // namespace clusterbench::scene
