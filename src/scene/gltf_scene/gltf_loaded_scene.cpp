#include <cmath>
#include <optional>

#include "scene/gltf_scene/gltf_checked.h"

namespace clusterbench::scene {
namespace {

using nlohmann::json;

// An index below `count`, if the value is one.
std::optional<std::size_t> index_below(const json& value, std::size_t count) {
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

LoadedScene loaded_scene(const JsonLocation& root, std::optional<std::size_t> wanted) {
  const json &document = root.value(), &scenes = array_of(document, "scenes");
  const bool has_nodes = root.has("nodes") && document["nodes"].is_array();
  const std::size_t count = has_nodes ? root.at("nodes").size() : 0;
  LoadedScene loaded;
  loaded.nodes.assign(count, true);
  const auto chosen = wanted              ? wanted
                      : root.has("scene") ? index_below(document["scene"], scenes.size())
                                          : index_below(0, scenes.size());
  if (!chosen) return loaded;
  loaded.scene = *chosen;
  loaded.nodes.assign(count, false);
  if (!has_nodes) return loaded;
  const JsonLocation nodes = root.at("nodes");
  std::vector<std::uint32_t> waiting;
  const auto visit = [&](const json& indices) {
    // Pushed in reverse, so that nodes are visited in the order of the list, usually that of the text.
    for (auto index = indices.rbegin(); index != indices.rend(); ++index) {
      const auto node = index_below(*index, count);
      if (!node || loaded.nodes[*node]) continue;
      loaded.nodes[*node] = true;
      waiting.push_back(static_cast<std::uint32_t>(*node));
    }
  };
  visit(array_of(scenes[*chosen], "nodes"));
  while (!waiting.empty()) {
    const JsonLocation node = nodes.at(waiting.back());
    waiting.pop_back();
    visit(array_of(node.value(), "children"));
  }
  return loaded;
}

}  // namespace clusterbench::scene
