// load_gltf: the checked document becomes a Scene.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "core/error.h"
#include "core/memory.h"
#include "core/text.h"
#include "scene/animation.h"
#include "scene/gltf_document/gltf_accessor.h"
#include "scene/gltf_document/gltf_container.h"
#include "scene/gltf_scene/gltf_checked.h"
#include "scene/gltf_scene/gltf_choice.h"
#include "scene/gltf_scene/gltf_keys.h"
#include "scene/gltf_scene/gltf_pointers.h"
#include "scene/gltf_scene/gltf_unread.h"
#include "scene/scene.h"
#include "scene/world_check.h"

namespace clusterbench::scene {
namespace {

std::string first_name(const std::string& node, const std::string& definition, const char* kind, std::size_t number) {
  if (!node.empty()) return node;
  return definition.empty() ? kind + std::string(" ") + std::to_string(number) : definition;
}

// Adds a checked document's nodes to a scene, with their lights and cameras: depth first, children in their order,
// parents before children. Reads each node again, so that only the scene's own nodes use memory.
class NodePlacer {
 public:
  NodePlacer(const JsonLocation& root, const CheckedDocument& document, Scene& scene)
      : root_(root), document_(document), lights_(light_definitions(root)), scene_(scene) {
    placed_.assign(document.nodes.size(), -1);
  }

  // The index in the scene for each of the document's nodes; -1: not part of the scene.
  std::vector<std::int32_t> place(const LoadedScene& loaded) {
    reserve(loaded);
    push(document_.roots, -1);
    while (!waiting_.empty()) {
      const auto [index, parent] = waiting_.back();
      waiting_.pop_back();
      add(index, parent);
      push(document_.nodes.children_of(index), placed_[index]);
    }
    return std::move(placed_);
  }

 private:
  // Reserves exactly this much; checks the limit before it allocates.
  void reserve(const LoadedScene& loaded) {
    std::size_t nodes = 0, lights = 0;
    for (std::size_t i = 0; i < loaded.nodes.size(); ++i) {
      if (!loaded.nodes[i]) continue;
      ++nodes;
      lights += document_.nodes.light[i] >= 0 ? 1 : 0;
    }
    check_memory("nodes of a scene", nodes, sizeof(Node) + sizeof(Mat4d), "use fewer nodes");
    check_memory("lights of a scene", lights, sizeof(Light) + sizeof(WorldLight), "use fewer lights");
    scene_.nodes.reserve(nodes);
    scene_.lights.reserve(lights);
  }

  void push(std::span<const std::uint32_t> nodes, std::int32_t parent) {
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) waiting_.emplace_back(*node, parent);
  }

  void add(std::uint32_t index, std::int32_t parent) {
    const auto location = static_cast<std::int32_t>(scene_.nodes.size());
    placed_[index] = location;
    ReadNode read = read_node(root_, root_.at("nodes").at(index), document_.nodes.size());
    read.node.parent = parent;
    read.node.gltf_index = static_cast<int>(index);
    if (read.light >= 0) add_light(read, location);
    if (read.camera >= 0) add_camera(read, location);
    if (read.box_half_extents_m)
      scene_.boxes.push_back(
          {first_name(read.node.name, "", "box", scene_.boxes.size()), location, *read.box_half_extents_m});
    scene_.nodes.push_back(std::move(read.node));
  }

  void add_light(const ReadNode& read, std::int32_t location) {
    std::optional<Light> light = read_light(lights_->at(static_cast<std::size_t>(read.light)));
    if (!light) return;
    light->node = location;
    light->definition = read.light;
    light->name = first_name(read.node.name, light->name, "light", scene_.lights.size());
    scene_.lights.push_back(std::move(*light));
  }

  void add_camera(const ReadNode& read, std::int32_t location) {
    const std::optional<Camera>& definition = document_.cameras[static_cast<std::size_t>(read.camera)];
    if (!definition) return;
    Camera camera = *definition;
    camera.node = location;
    camera.definition = read.camera;
    camera.name = first_name(read.node.name, definition->name, "camera", scene_.cameras.size());
    scene_.cameras.push_back(std::move(camera));
  }

  const JsonLocation& root_;
  const CheckedDocument& document_;
  std::optional<JsonLocation> lights_;
  Scene& scene_;
  std::vector<std::int32_t> placed_;
  std::vector<std::pair<std::uint32_t, std::int32_t>> waiting_;  // a node of the document, its parent in the scene
};

Interpolation interpolation_of(const std::string& name) {
  if (name == "STEP") return Interpolation::step;
  return name == "CUBICSPLINE" ? Interpolation::cubic_spline : Interpolation::linear;
}

// The nodes that move a light, a camera or a box: with one of their own, or one below them.
std::vector<bool> carrying_nodes(const Scene& scene) {
  std::vector<bool> carries(scene.nodes.size(), false);
  const auto mark = [&](const auto& items) {
    for (const auto& item : items) carries[static_cast<std::size_t>(item.node)] = true;
  };
  mark(scene.lights);
  mark(scene.cameras);
  mark(scene.boxes);
  for (std::size_t i = scene.nodes.size(); i-- > 0;)  // parents come first
    if (const int parent = scene.nodes[i].parent; carries[i] && parent >= 0)
      carries[static_cast<std::size_t>(parent)] = true;
  return carries;
}

// Adds the channels of checked animations; if several move the same property, the last one wins.
class ChannelsOfFile {
 public:
  ChannelsOfFile(const std::vector<std::int32_t>& placed, AccessorReader& reader, Scene& scene)
      : placed_(placed), reader_(reader), scene_(scene), carries_(carrying_nodes(scene)) {}

  void add(const nlohmann::json& animation, const JsonLocation& location) {
    for (const nlohmann::json& channel : animation["channels"]) add_channel(animation["samplers"], channel, location);
  }
  bool moves_twice() const { return moves_twice_; }
  // Called after all are added.
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
    const KeysMove moved = is_node && !carries_[static_cast<std::size_t>(placed_[static_cast<std::size_t>(index)])]
                               ? KeysMove::neither
                               : KeysMove::lights_or_cameras;
    std::optional<Channel> keys =
        read_keys(reader_, sampler_location, sampler["input"].get<std::size_t>(), sampler["output"].get<std::size_t>(),
                  static_cast<ChannelPath>(from["path"].get<int>()), from["is_pointer"].get<bool>(),
                  interpolation_of(sampler["interpolation"].get<std::string>()), moved);
    if (!keys) return;
    (is_node ? keys->node : keys->definition) = is_node ? placed_[static_cast<std::size_t>(index)] : index;
    scene_.duration_s = std::max(scene_.duration_s, keys->times_s.back());
    std::vector<Channel>& channels = is_node                     ? scene_.channels
                                     : kind == TargetKind::light ? scene_.light_channels
                                                                 : scene_.camera_channels;
    const auto [known, first] = channel_of_.try_emplace({kind, index, keys->path}, channels.size());
    if (first) {
      channels.push_back(std::move(*keys));
      return;
    }
    moves_twice_ = true;
    location.at("channels")
        .at(from["channel"].get<std::size_t>())
        .warn((is_node                     ? "moves node "
               : kind == TargetKind::light ? "moves light "
                                           : "moves camera ") +
              std::to_string(index) + " (" + from["name"].get<std::string>() + ") again; this animation wins");
    channels[known->second] = std::move(*keys);
  }

  const std::vector<std::int32_t>& placed_;
  AccessorReader& reader_;
  Scene& scene_;
  bool moves_twice_ = false;
  std::vector<bool> carries_;  // by node
  // index of the channel that moves a property
  std::map<std::tuple<TargetKind, int, ChannelPath>, std::size_t> channel_of_;
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

// Two cameras of one name become "name" and "name-2", so that each can be selected.
void make_camera_names_unique(Scene& scene) {
  std::set<std::string> used;
  std::map<std::string, int> last;
  for (Camera& camera : scene.cameras) {
    const std::string name = camera.name;
    int& number = last.try_emplace(name, 1).first->second;
    while (!used.insert(camera.name).second) camera.name = name + "-" + std::to_string(++number);
  }
}

void mark_animated_cameras(Scene& scene) {
  const std::vector<bool> moved = moving_nodes(scene);
  std::set<int> moved_cameras;
  for (const Channel& channel : scene.camera_channels) moved_cameras.insert(channel.definition);
  for (Camera& camera : scene.cameras)
    camera.animated = moved[static_cast<std::size_t>(camera.node)] || moved_cameras.contains(camera.definition);
}

void check_world(const Scene& scene, const JsonLocation& root) {
  const std::optional<std::size_t> node = first_node_without_place(scene);
  if (node)
    root.at("nodes")
        .at(static_cast<std::size_t>(scene.nodes[*node].gltf_index))
        .refuse("its position in the world is not a number: the transforms above it are too large");
}

Scene read_scene(const std::filesystem::path& path, const GltfChoice& choice) {
  GltfFile file;
  read_gltf_file(path, file, k_lazy_from_bytes);
  Warnings warnings;
  AccessorReader reader(file, warnings);
  const JsonLocation& root = reader.root();
  if (!file.repeated_key.empty()) root.warn(file.repeated_key + "; the later value counts");
  if (file.has_byte_order_mark) root.warn("begins with a byte order mark, which JSON has none of; skipped");
  Scene scene;
  scene.name = printable(path.stem().string());
  scene.path = path;
  const ChosenParts chosen = chosen_parts(root, choice);
  const LoadedScene loaded = loaded_scene(root, chosen.scene);
  CheckedDocument document = checked_document(root, loaded, chosen.animation);
  scene.contents = contents_of(root, loaded);
  if (!chosen.scene) warn_of_other_scenes(root, scene.contents);
  count_unread_lights(root, loaded, scene.contents);
  // The first reading has already reported the warnings.
  Warnings reported;
  const std::vector<std::int32_t> placed =
      NodePlacer(JsonLocation(file.name, file.json, reported, "", &file.lazy), document, scene).place(loaded);
  const nlohmann::json& animations = document.animations;
  ChannelsOfFile channels(placed, reader, scene);
  for (std::size_t i = 0; i < animations.size(); ++i) channels.add(animations[i], root.at("animations").at(i));
  channels.finish();
  if (channels.moves_twice())
    root.at("animations")
        .warn(number_of(animations.size(), "animation") + ", played together: " + numbered(scene.contents.animations) +
              "; the key animation (--animation) chooses one");
  mark_animated_cameras(scene);
  make_camera_names_unique(scene);
  leave_out_hidden_lights(scene, warnings);
  check_world(scene, root);
  reader.add_external_bytes(file.hash);
  scene.sha256 = file.hash.hex();
  scene.warnings = warnings.lines();
  return scene;
}

}  // namespace

Scene load_gltf(const std::filesystem::path& path, const GltfChoice& choice) {
  return within_memory(path.string(), [&] { return read_scene(path, choice); });
}

}  // namespace clusterbench::scene
