#include <cmath>
#include <optional>

#include "scene/gltf_checked.h"

namespace clusterbench::scene {
namespace {

using nlohmann::json;

// An index below `count`, if the value is one.
std::optional<std::size_t> index_in(const json& value, std::size_t count) {
  const double number = value.is_number() ? value.get<double>() : -1.0;
  if (!(number >= 0.0 && number < static_cast<double>(count)) || number != std::floor(number)) return std::nullopt;
  return static_cast<std::size_t>(number);
}

const json& array_of(const json& object, const char* key) {
  static const json none = json::array();
  if (!object.is_object()) return none;
  const auto found = object.find(key);
  return found != object.end() && found->is_array() ? *found : none;
}

}  // namespace

LoadedScene loaded_scene(const JsonLocation& root) {
  const json &document = root.value(), &nodes = array_of(document, "nodes"), &scenes = array_of(document, "scenes");
  LoadedScene loaded;
  loaded.nodes.assign(nodes.size(), true);
  const auto chosen = root.has("scene") ? index_in(document["scene"], scenes.size()) : index_in(0, scenes.size());
  if (!chosen) return loaded;
  loaded.scene = *chosen;
  loaded.nodes.assign(nodes.size(), false);
  std::vector<std::size_t> waiting;
  const auto visit = [&](const json& indices) {
    for (const json& index : indices) {
      const auto node = index_in(index, nodes.size());
      if (!node || loaded.nodes[*node]) continue;
      loaded.nodes[*node] = true;
      waiting.push_back(*node);
    }
  };
  visit(array_of(scenes[*chosen], "nodes"));
  while (!waiting.empty()) {
    const json& node = nodes[waiting.back()];
    waiting.pop_back();
    visit(array_of(node, "children"));
  }
  return loaded;
}

}  // namespace clusterbench::scene
