#include "scene/gltf_scene/gltf_unread.h"

#include <map>

#include "core/text.h"

namespace clusterbench::scene {
namespace {

using nlohmann::json;

// KHR_lights, KHR_lights_common, EXT_lights_ies and similar extensions of nodes.
bool names_lights(const std::string& extension) {
  return extension != k_punctual && extension.find("_lights") != std::string::npos;
}

const json* extensions_of(const json& node) {
  if (!node.is_object()) return nullptr;
  const auto found = node.find("extensions");
  return found != node.end() && found->is_object() ? &*found : nullptr;
}

// Nodes with an extension of lights: the number without a light that is read, and the number with one as well.
struct Extension {
  std::size_t alone = 0, beside = 0, first = 0;
};

void warn_of(const JsonLocation& nodes, const std::map<std::string, Extension>& extensions) {
  for (const auto& [name, found] : extensions) {
    if (found.alone > 0)
      nodes.at(found.first)
          .warn(number_of(found.alone, "node") + " with lights of " + name +
                ", which is not read; lights are those of " + k_punctual);
    if (found.beside > 0)
      nodes.warn(number_of(found.beside, "light") + " also with " + name + ", which is not read: " +
                 (name == "EXT_lights_ies" ? "without its profile, as far as the range" : "as its own type"));
  }
}

}  // namespace

void count_unread_lights(const JsonLocation& root, const LoadedScene& loaded, GltfContents& contents) {
  if (!root.has("nodes")) return;
  const JsonLocation nodes = root.at("nodes");
  std::map<std::string, Extension> extensions;
  std::size_t elsewhere = 0, first_elsewhere = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const JsonLocation node = nodes.at(i);
    const json* own = extensions_of(node.value());
    if (own == nullptr) continue;
    const bool is_punctual = own->contains(k_punctual);
    if (!loaded.nodes[i]) {
      if (is_punctual && elsewhere++ == 0) first_elsewhere = i;
      continue;
    }
    for (const auto& [name, value] : own->items()) {
      if (!names_lights(name)) continue;
      Extension& found = extensions[name];
      if (!is_punctual && found.alone == 0) found.first = i;
      ++(is_punctual ? found.beside : found.alone);
    }
  }
  if (elsewhere > 0)
    nodes.at(first_elsewhere)
        .warn(number_of(elsewhere, "light") + " of nodes that do not stand in the scene that is read, so not read" +
              (contents.scenes.size() > 1 ? "; the key scene (--scene) chooses another scene" : ""));
  warn_of(nodes, extensions);
  contents.unread_lights = elsewhere;
  for (const auto& [name, found] : extensions) contents.unread_lights += found.alone;
}

}  // namespace clusterbench::scene
