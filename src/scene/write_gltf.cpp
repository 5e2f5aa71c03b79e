#include "scene/write_gltf.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace clusterbench::scene {
namespace {

using Json = nlohmann::ordered_json;

Json node_json(const Node& node) {
  Json out = Json::object();
  if (!node.name.empty()) out["name"] = node.name;
  if (node.has_matrix) {
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 4; ++row) out["matrix"].push_back(node.matrix[column][row]);
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
  out["intensity"] = light.intensity;
  out["range"] = light.range_m;
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
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    document["extensions"]["KHR_lights_punctual"]["lights"].push_back(light_json(scene.lights[i]));
    node(scene.lights[i].node)["extensions"]["KHR_lights_punctual"]["light"] = i;
  }
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    document["cameras"].push_back(camera_json(scene.cameras[i]));
    node(scene.cameras[i].node)["camera"] = i;
  }
  return document.dump(1) + "\n";
}

}  // namespace clusterbench::scene
