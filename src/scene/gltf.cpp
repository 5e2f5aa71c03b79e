// load_gltf: the checked document goes through tinygltf into a model, the model into a Scene.

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "core/error.h"
#include "core/text.h"
#include "scene/animation.h"
#include "scene/gltf_accessor.h"
#include "scene/gltf_checked.h"
#include "scene/gltf_container.h"
#include "scene/gltf_keys.h"
#include "scene/gltf_pointers.h"
#include "scene/scene.h"

namespace clusterbench::scene {
namespace {

constexpr const char* k_lights = "KHR_lights_punctual";

// The document holds no images, buffers or meshes, so tinygltf opens no file and decodes nothing.
tinygltf::Model parsed_model(const nlohmann::json& document, const std::string& file) {
  const std::string text = document.dump();
  if (text.size() > std::numeric_limits<unsigned int>::max()) throw Error(file, "", "the scene is larger than 4 GiB");
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader([](tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int,
                           void*) { return true; },
                        nullptr);
  tinygltf::Model model;
  std::string error, warning;
  if (!loader.LoadASCIIFromString(&model, &error, &warning, text.c_str(), static_cast<unsigned int>(text.size()), "")) {
    std::replace(error.begin(), error.end(), '\n', ' ');
    throw Error(file, "/", error);
  }
  return model;
}

Vec3d vec3_or(const std::vector<double>& numbers, const Vec3d& otherwise) {
  return numbers.size() == 3 ? Vec3d(numbers[0], numbers[1], numbers[2]) : otherwise;
}

// `definition` is the node's checked JSON: tinygltf knows no visibility.
Node node_of(const tinygltf::Node& from, const nlohmann::json& definition, int gltf_index, int parent) {
  Node node;
  node.name = from.name;
  node.parent = parent;
  node.gltf_index = gltf_index;
  node.has_matrix = !from.matrix.empty();
  for (std::size_t i = 0; i < from.matrix.size(); ++i) {
    node.matrix[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = from.matrix[i];
  }
  node.translation = vec3_or(from.translation, node.translation);
  node.scale = vec3_or(from.scale, node.scale);
  node.visible = definition.value("visible", true);
  if (from.rotation.size() == 4)
    node.rotation = {from.rotation[0], from.rotation[1], from.rotation[2], from.rotation[3]};
  return node;
}

std::vector<int> roots_of(const tinygltf::Model& model) {
  if (!model.scenes.empty()) return model.scenes[static_cast<std::size_t>(std::max(model.defaultScene, 0))].nodes;
  std::vector<char> is_child(model.nodes.size(), 0);
  for (const tinygltf::Node& node : model.nodes) {
    for (const int child : node.children) is_child[static_cast<std::size_t>(child)] = 1;
  }
  std::vector<int> roots;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    if (!is_child[i]) roots.push_back(static_cast<int>(i));
  }
  return roots;
}

// Depth first, children in their order, parents before children. Returns scene node -> index in `nodes`.
std::map<int, int> add_nodes(const tinygltf::Model& model, const nlohmann::json& definitions, Scene& scene) {
  std::map<int, int> placed;
  std::vector<std::pair<int, int>> waiting;  // glTF index, parent's index
  const auto push = [&](const std::vector<int>& nodes, int parent) {
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) waiting.emplace_back(*node, parent);
  };
  push(roots_of(model), -1);
  while (!waiting.empty()) {
    const auto [index, parent] = waiting.back();
    waiting.pop_back();
    const int location = static_cast<int>(scene.nodes.size());
    const tinygltf::Node& from = model.nodes[static_cast<std::size_t>(index)];
    scene.nodes.push_back(node_of(from, definitions[static_cast<std::size_t>(index)], index, parent));
    placed.emplace(index, location);
    push(from.children, location);
  }
  return placed;
}

std::string first_name(const std::string& node, const std::string& definition, const char* kind, std::size_t number) {
  if (!node.empty()) return node;
  return definition.empty() ? kind + std::string(" ") + std::to_string(number) : definition;
}

// `definition` is the light's checked JSON: tinygltf's Light cannot tell an absent range from 0.
Light light_of(const tinygltf::Light& from, const nlohmann::json& definition, int node) {
  Light light;
  light.node = node;
  light.type = from.type == "spot"          ? LightType::spot
               : from.type == "directional" ? LightType::directional
                                            : LightType::point;
  light.color = vec3_or(from.color, light.color);
  light.intensity = from.intensity;
  if (definition.contains("range")) light.range_given_m = from.range;
  if (light.type == LightType::directional) {
    light.range_m = std::numeric_limits<double>::infinity();
  } else if (light.range_given_m) {
    light.range_m = *light.range_given_m;
  }
  if (light.type == LightType::spot) {
    light.inner_cone_rad = from.spot.innerConeAngle;
    light.outer_cone_rad = from.spot.outerConeAngle;
  }
  return light;
}

// Absent (0) or the largest number of single precision: infinitely far.
double far_of(double zfar) {
  return zfar > 0.0 && !is_float_max(zfar) ? zfar : std::numeric_limits<double>::infinity();
}

Camera camera_of(const tinygltf::Camera& from, int node) {
  Camera camera;
  camera.node = node;
  CameraProjection& projection = camera.projection;
  projection.orthographic = from.type == "orthographic";
  if (projection.orthographic) {
    projection.xmag_m = from.orthographic.xmag;
    projection.ymag_m = from.orthographic.ymag;
    projection.near_m = from.orthographic.znear;
    projection.far_m = far_of(from.orthographic.zfar);
  } else {
    projection.yfov_rad = from.perspective.yfov;
    projection.near_m = from.perspective.znear;
    projection.far_m = far_of(from.perspective.zfar);
    if (from.perspective.aspectRatio > 0.0) projection.aspect_ratio = from.perspective.aspectRatio;
    if (from.extras.Has("clusterbench_sides")) {
      const tinygltf::Value sides = from.extras.Get("clusterbench_sides");
      const auto side = [&](std::size_t i) { return sides.Get(i).GetNumberAsDouble(); };
      projection.sides = ProjectionSides{side(0), side(1), side(2), side(3)};
    }
  }
  return camera;
}

void add_light(const tinygltf::Model& model, const nlohmann::json& definitions, const tinygltf::Node& from, int node,
               Scene& scene) {
  const auto reference = from.extensions.find(k_lights);
  if (reference == from.extensions.end()) return;
  const auto index = static_cast<std::size_t>(reference->second.Get("light").GetNumberAsInt());
  Light light = light_of(model.lights[index], definitions[index], node);
  light.definition = static_cast<int>(index);
  light.name = first_name(from.name, model.lights[index].name, "light", scene.lights.size());
  scene.lights.push_back(std::move(light));
}

void add_camera(const tinygltf::Model& model, const tinygltf::Node& from, int node, Scene& scene) {
  if (from.camera < 0) return;
  const tinygltf::Camera& definition = model.cameras[static_cast<std::size_t>(from.camera)];
  Camera camera = camera_of(definition, node);
  camera.definition = from.camera;
  camera.name = first_name(from.name, definition.name, "camera", scene.cameras.size());
  scene.cameras.push_back(std::move(camera));
}

void add_box(const tinygltf::Node& from, int node, Scene& scene) {
  if (!from.extras.Has("clusterbench_box")) return;
  const tinygltf::Value half_extents = from.extras.Get("clusterbench_box").Get("half_extents");
  OrientedBox box;
  box.node = node;
  box.name = first_name(from.name, "", "box", scene.boxes.size());
  for (int axis = 0; axis < 3; ++axis) {
    box.half_extents_m[axis] = half_extents.Get(static_cast<std::size_t>(axis)).GetNumberAsDouble();
  }
  scene.boxes.push_back(std::move(box));
}

void add_things(const tinygltf::Model& model, const nlohmann::json& document, Scene& scene) {
  const nlohmann::json& definitions = document["extensions"][k_lights]["lights"];
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const tinygltf::Node& from = model.nodes[static_cast<std::size_t>(scene.nodes[i].gltf_index)];
    add_light(model, definitions, from, static_cast<int>(i), scene);
    add_camera(model, from, static_cast<int>(i), scene);
    add_box(from, static_cast<int>(i), scene);
  }
}

Interpolation interpolation_of(const std::string& name) {
  if (name == "STEP") return Interpolation::step;
  return name == "CUBICSPLINE" ? Interpolation::cubic_spline : Interpolation::linear;
}

// Which nodes move a light, a camera or a box: their own, or one below them.
std::vector<bool> carrying_nodes(const Scene& scene) {
  std::vector<bool> carries(scene.nodes.size(), false);
  const auto mark = [&](const auto& things) {
    for (const auto& thing : things) carries[static_cast<std::size_t>(thing.node)] = true;
  };
  mark(scene.lights);
  mark(scene.cameras);
  mark(scene.boxes);
  for (std::size_t i = scene.nodes.size(); i-- > 0;)  // parents come first
    if (const int parent = scene.nodes[i].parent; carries[i] && parent >= 0)
      carries[static_cast<std::size_t>(parent)] = true;
  return carries;
}

// Adds the channels of checked animations; of several that move the same the last one wins.
class ChannelsOfFile {
 public:
  ChannelsOfFile(const std::map<int, int>& placed, AccessorReader& reader, Scene& scene)
      : placed_(placed), reader_(reader), scene_(scene), carries_(carrying_nodes(scene)) {}

  void add(const nlohmann::json& animation, const JsonLocation& location) {
    for (const nlohmann::json& channel : animation["channels"]) add_channel(animation["samplers"], channel, location);
  }
  // When all are added.
  void finish() {
    for (std::vector<Channel>* channels : {&scene_.light_channels, &scene_.camera_channels})
      std::stable_sort(channels->begin(), channels->end(),
                       [](const Channel& a, const Channel& b) { return a.definition < b.definition; });
  }

 private:
  void add_channel(const nlohmann::json& samplers, const nlohmann::json& from, const JsonLocation& location) {
    const std::size_t number = from["sampler"].get<std::size_t>();
    const nlohmann::json& sampler = samplers[number];
    const JsonLocation sampler_location = location.at("samplers").at(number);
    const auto kind = static_cast<TargetKind>(from["kind"].get<int>());
    const int index = from["index"].get<int>();
    const bool is_node = kind == TargetKind::node;
    const KeysMove moved = is_node && !carries_[static_cast<std::size_t>(placed_.at(index))]
                               ? KeysMove::neither
                               : KeysMove::lights_or_cameras;
    std::optional<Channel> keys =
        read_keys(reader_, sampler_location, sampler["input"].get<std::size_t>(), sampler["output"].get<std::size_t>(),
                  static_cast<ChannelPath>(from["path"].get<int>()), from["is_pointer"].get<bool>(),
                  interpolation_of(sampler["interpolation"].get<std::string>()), moved);
    if (!keys) return;
    (is_node ? keys->node : keys->definition) = is_node ? placed_.at(index) : index;
    scene_.duration_s = std::max(scene_.duration_s, keys->times_s.back());
    std::vector<Channel>& channels = is_node                     ? scene_.channels
                                     : kind == TargetKind::light ? scene_.light_channels
                                                                 : scene_.camera_channels;
    const auto [known, first] = taken_.try_emplace({kind, index, keys->path}, channels.size());
    if (first) {
      channels.push_back(std::move(*keys));
      return;
    }
    location.at("channels")
        .at(from["channel"].get<std::size_t>())
        .warn((is_node                     ? "moves node "
               : kind == TargetKind::light ? "moves light "
                                           : "moves camera ") +
              std::to_string(index) + " (" + from["name"].get<std::string>() + ") again; this animation wins");
    channels[known->second] = std::move(*keys);
  }

  const std::map<int, int>& placed_;
  AccessorReader& reader_;
  Scene& scene_;
  std::vector<bool> carries_;                                              // by node
  std::map<std::tuple<TargetKind, int, ChannelPath>, std::size_t> taken_;  // which channel moves what
};

// KHR_node_visibility: lights of nodes that are never visible are not rendered, so they are not counted.
void leave_out_hidden_lights(Scene& scene, Warnings& warnings) {
  std::vector<bool> may_show(scene.nodes.size()), may_change(scene.nodes.size(), false);
  for (const Channel& channel : scene.channels)
    if (channel.path == ChannelPath::visible) may_change[static_cast<std::size_t>(channel.node)] = true;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const int parent = scene.nodes[i].parent;
    may_show[i] =
        (scene.nodes[i].visible || may_change[i]) && (parent < 0 || may_show[static_cast<std::size_t>(parent)]);
  }
  const auto is_hidden = [&](const Light& light) { return !may_show[static_cast<std::size_t>(light.node)]; };
  const auto first = std::find_if(scene.lights.begin(), scene.lights.end(), is_hidden);
  if (first == scene.lights.end()) return;
  const std::string name = first->name;
  const std::size_t hidden = std::erase_if(scene.lights, is_hidden);
  warnings.add("/nodes", one_line(std::to_string(hidden) + (hidden == 1 ? " light" : " lights") +
                                  " of invisible nodes (KHR_node_visibility) not rendered, so left out: " +
                                  (hidden == 1 ? "'" : "first '") + name + "'"));
}

// Two cameras of one name become "name" and "name-2", so that each can be asked for.
void tell_cameras_apart(Scene& scene) {
  std::set<std::string> taken;
  std::map<std::string, int> last;
  for (Camera& camera : scene.cameras) {
    const std::string name = camera.name;
    int& number = last.try_emplace(name, 1).first->second;
    while (!taken.insert(camera.name).second) camera.name = name + "-" + std::to_string(++number);
  }
}

void mark_animated_cameras(Scene& scene) {
  const std::vector<bool> moved = moving_nodes(scene);
  std::set<int> moved_cameras;
  for (const Channel& channel : scene.camera_channels) moved_cameras.insert(channel.definition);
  for (Camera& camera : scene.cameras)
    camera.animated = moved[static_cast<std::size_t>(camera.node)] || moved_cameras.contains(camera.definition);
}

// Numbers that are each fine can multiply to infinity down the tree.
void check_world(const Scene& scene, const JsonLocation& root) {
  const std::vector<Mat4d> world = world_transforms(scene, 0.0);
  for (std::size_t i = 0; i < world.size(); ++i) {
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 4; ++row) {
        if (std::isfinite(world[i][column][row])) continue;
        root.at("nodes")
            .at(static_cast<std::size_t>(scene.nodes[i].gltf_index))
            .refuse("its position in the world is not a number: the transforms above it are too large");
      }
    }
  }
}

}  // namespace

Scene load_gltf(const std::filesystem::path& path) {
  GltfFile file;
  read_gltf_file(path, file);
  Warnings warnings;
  AccessorReader reader(file, warnings);
  const JsonLocation& root = reader.root();
  if (file.has_byte_order_mark) root.warn("begins with a byte order mark, which JSON has none of; skipped");
  Scene scene;
  scene.name = printable(path.stem().string());
  scene.path = path;
  nlohmann::json document = checked_document(root);
  const nlohmann::json animations = std::move(document["animations"]);
  document.erase("animations");  // tinygltf knows no pointers
  const tinygltf::Model model = parsed_model(document, file.name);
  const std::map<int, int> placed = add_nodes(model, document["nodes"], scene);
  add_things(model, document, scene);
  ChannelsOfFile channels(placed, reader, scene);
  for (std::size_t i = 0; i < animations.size(); ++i) channels.add(animations[i], root.at("animations").at(i));
  channels.finish();
  mark_animated_cameras(scene);
  tell_cameras_apart(scene);
  leave_out_hidden_lights(scene, warnings);
  check_world(scene, root);
  scene.sha256 = sha256_hex(file.bytes + reader.external_bytes());
  scene.warnings = warnings.lines();
  return scene;
}

}  // namespace clusterbench::scene
