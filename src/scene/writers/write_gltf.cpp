#include "scene/writers/write_gltf.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

namespace clusterbench::scene {
namespace {

using Json = nlohmann::ordered_json;

Json node_json(const Node& node) {
  Json out = Json::object();
  if (!node.name.empty()) out["name"] = node.name;
  if (node.matrix) {
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 4; ++row) out["matrix"].push_back((*node.matrix)[column][row]);
    return out;
  }
  if (node.translation != Vec3d(0.0)) out["translation"] = {node.translation.x, node.translation.y, node.translation.z};
  if (node.rotation != Vec4d(0.0, 0.0, 0.0, 1.0))
    out["rotation"] = {node.rotation.x, node.rotation.y, node.rotation.z, node.rotation.w};
  if (node.scale != Vec3d(1.0)) out["scale"] = {node.scale.x, node.scale.y, node.scale.z};
  return out;
}

Json light_json(const Light& light) {
  assert(std::isfinite(light.range_m));
  constexpr const char* k_types[] = {"point", "spot", "directional"};
  Json out{{"type", k_types[static_cast<int>(light.type)]}};
  if (light.type == LightType::directional) return out;
  if (light.color != Vec3d(1.0)) out["color"] = {light.color.x, light.color.y, light.color.z};
  out["intensity"] = light.intensity;
  // A range of 0 would be read as none, and one this short as 0 (ranges.cpp).
  constexpr double k_read_as_nothing_m = 1e-16;
  out["range"] = light.range_m > 0.0 ? light.range_m : k_read_as_nothing_m;
  if (light.type == LightType::spot)
    out["spot"] = {{"innerConeAngle", light.inner_cone_rad}, {"outerConeAngle", light.outer_cone_rad}};
  return out;
}

Json camera_json(const Camera& camera) {
  const CameraProjection& projection = camera.projection;
  if (projection.orthographic) {
    // glTF has no infinite orthographic view; the loader reads the largest float as one.
    const double far_m = std::min(projection.far_m, static_cast<double>(std::numeric_limits<float>::max()));
    return {
        {"type", "orthographic"},
        {"orthographic",
         {{"xmag", projection.xmag_m}, {"ymag", projection.ymag_m}, {"znear", projection.near_m}, {"zfar", far_m}}}};
  }
  Json out{{"type", "perspective"}, {"perspective", {{"yfov", projection.yfov_rad}, {"znear", projection.near_m}}}};
  if (std::isfinite(projection.far_m)) out["perspective"]["zfar"] = projection.far_m;
  if (projection.aspect_ratio) out["perspective"]["aspectRatio"] = *projection.aspect_ratio;
  if (projection.sides)
    out["extras"]["clusterbench_sides"] = {projection.sides->left, projection.sides->right, projection.sides->bottom,
                                           projection.sides->top};
  return out;
}

std::string base64(const std::string& bytes) {
  constexpr char k_digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u;
    };
    const unsigned all = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? k_digits[all >> (18 - 6 * k) & 63u] : '=';
  }
  return text;
}

// One animation with a buffer of its own in the document.
class AnimationWriter {
 public:
  explicit AnimationWriter(Json& document) : document_(document) {}

  void add(const Channel& channel) {
    assert(channel.interpolation == Interpolation::step);
    const std::size_t components = components_of(channel.path);
    std::vector<double> values;
    for (const Vec4d& value : channel.values)
      for (std::size_t i = 0; i < components; ++i) values.push_back(value[static_cast<int>(i)]);
    const std::size_t output = accessor(values, components);
    samplers_.push_back({{"input", times(channel.times_s)}, {"output", output}, {"interpolation", "STEP"}});
    channels_.push_back({{"sampler", samplers_.size() - 1}, {"target", target(channel)}});
  }
  void finish() {
    if (channels_.empty()) return;
    document_["animations"] = Json::array({Json{{"channels", channels_}, {"samplers", samplers_}}});
    document_["buffers"] = Json::array(
        {Json{{"byteLength", bytes_.size()}, {"uri", "data:application/octet-stream;base64," + base64(bytes_)}}});
    if (has_pointers_) document_["extensionsUsed"].push_back("KHR_animation_pointer");
  }

 private:
  static std::size_t components_of(ChannelPath path) {
    return path == ChannelPath::rotation ? 4 : path == ChannelPath::translation ? 3 : 1;
  }

  Json target(const Channel& channel) {
    if (channel.node >= 0)
      return {{"node", channel.node}, {"path", channel.path == ChannelPath::rotation ? "rotation" : "translation"}};
    has_pointers_ = true;
    const char* property = channel.path == ChannelPath::range ? "/range" : "/spot/outerConeAngle";
    const std::string pointer =
        "/extensions/KHR_lights_punctual/lights/" + std::to_string(channel.definition) + property;
    return {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}};
  }

  // Channels with the same keys share them.
  std::size_t times(const std::vector<double>& times_s) {
    const auto [known, is_new] = times_.try_emplace(times_s, 0);
    if (!is_new) return known->second;
    known->second = accessor(times_s, 1);
    document_["accessors"].back()["min"] = {times_s.front()};
    document_["accessors"].back()["max"] = {times_s.back()};
    return known->second;
  }

  std::size_t accessor(const std::vector<double>& values, std::size_t components) {
    const std::size_t begin = bytes_.size();
    for (const double value : values) {
      const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
      for (unsigned shift = 0; shift < 32; shift += 8) bytes_ += static_cast<char>(bits >> shift & 0xffu);
    }
    document_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", begin}, {"byteLength", bytes_.size() - begin}});
    document_["accessors"].push_back({{"bufferView", document_["bufferViews"].size() - 1},
                                      {"componentType", 5126},
                                      {"count", values.size() / components},
                                      {"type", components == 1   ? "SCALAR"
                                               : components == 3 ? "VEC3"
                                                                 : "VEC4"}});
    return document_["accessors"].size() - 1;
  }

  Json& document_;
  Json channels_ = Json::array(), samplers_ = Json::array();
  std::string bytes_;
  std::map<std::vector<double>, std::size_t> times_;
  bool has_pointers_ = false;
};

}  // namespace

std::string to_gltf(const Scene& scene, const std::string& generator) {
  Json document{{"asset", {{"version", "2.0"}, {"generator", generator}}}};
  document["extensionsUsed"] = Json::array({"KHR_lights_punctual"});
  document["scene"] = 0;
  document["scenes"] = Json::array({Json{{"nodes", Json::array()}}});
  document["nodes"] = Json::array();
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const int parent = scene.nodes[i].parent;
    document["nodes"].push_back(node_json(scene.nodes[i]));
    Json& siblings =
        parent < 0 ? document["scenes"][0]["nodes"] : document["nodes"][static_cast<std::size_t>(parent)]["children"];
    siblings.push_back(i);
  }
  const auto node = [&](int index) -> Json& { return document["nodes"][static_cast<std::size_t>(index)]; };
  Json lights = Json::array();
  for (const Light& light : scene.lights) {
    if (light.type == LightType::box) {
      const Vec3d& half = light.half_extents_m;
      node(light.node)["extras"]["clusterbench_box"]["half_extents"] = {half.x, half.y, half.z};
      continue;
    }
    node(light.node)["extensions"]["KHR_lights_punctual"]["light"] = lights.size();
    lights.push_back(light_json(light));
  }
  if (!lights.empty()) document["extensions"]["KHR_lights_punctual"]["lights"] = lights;
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    document["cameras"].push_back(camera_json(scene.cameras[i]));
    node(scene.cameras[i].node)["camera"] = i;
  }
  AnimationWriter animation(document);
  for (const auto* channels : {&scene.channels, &scene.light_channels})
    for (const Channel& channel : *channels) animation.add(channel);
  animation.finish();
  return document.dump(1) + "\n";
}

}  // namespace clusterbench::scene
