#include "scene/gltf_scene/gltf_choice.h"

#include <algorithm>
#include <charconv>

#include "core/text.h"

namespace clusterbench::scene {
namespace {

using nlohmann::json;

// Names of the objects in a top-level array; "" for objects without one.
std::vector<std::string> names_of(const JsonLocation& root, const char* key) {
  std::vector<std::string> names;
  if (!root.has(key) || !root.value()[key].is_array()) return names;
  for (const json& entry : root.value()[key]) {
    const bool is_named = entry.is_object() && entry.contains("name") && entry["name"].is_string();
    names.push_back(is_named ? entry["name"].get<std::string>() : "");
  }
  return names;
}

std::optional<std::size_t> number_in(const std::string& text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::optional<std::size_t> index_in(const std::string& text, std::size_t count) {
  const std::optional<std::size_t> number = number_in(text);
  return number && *number < count ? number : std::nullopt;
}

// A name, or a number; a number after a # if another object has that number as its name.
std::optional<std::size_t> chosen(const JsonLocation& root, const char* key, const std::string& word,
                                  const std::string& wanted) {
  if (wanted.empty()) return std::nullopt;
  const std::vector<std::string> names = names_of(root, key);
  const auto count = std::count(names.begin(), names.end(), wanted);
  if (count > 1)
    root.refuse(std::to_string(count) + " of its " + key + " are called '" + wanted +
                "'; choose one by its number, with a #, as in #0: " + numbered(names));
  const std::optional<std::size_t> number = index_in(wanted, names.size());
  if (count == 1) {
    const auto named = static_cast<std::size_t>(std::find(names.begin(), names.end(), wanted) - names.begin());
    if (number && *number != named)
      root.refuse("'" + wanted + "' is the name of one of its " + key +
                  " and the number of another; choose one by its " + "number, with a #: #" + std::to_string(named) +
                  " is the one of this name, #" + wanted + " the other");
    return named;
  }
  if (number) return number;
  if (wanted.starts_with('#'))
    if (const std::optional<std::size_t> marked = index_in(wanted.substr(1), names.size())) return marked;
  const std::string hint = number_in(wanted) ? "" : did_you_mean(wanted, names);
  root.refuse("has no " + word + " '" + wanted + "'" + hint +
              (names.empty() ? "; it has none" : "; it has: " + numbered(names)));
}

}  // namespace

std::string numbered(const std::vector<std::string>& names) {
  constexpr std::size_t k_most = 12;
  std::string out;
  for (std::size_t i = 0; i < std::min(names.size(), k_most); ++i)
    out += (i > 0 ? ", " : "") + std::to_string(i) + (names[i].empty() ? "" : " '" + names[i] + "'");
  return names.size() > k_most ? out + " and " + std::to_string(names.size() - k_most) + " more" : out;
}

ChosenParts chosen_parts(const JsonLocation& root, const GltfChoice& choice) {
  return {chosen(root, "scenes", "scene", choice.scene), chosen(root, "animations", "animation", choice.animation)};
}

GltfContents contents_of(const JsonLocation& root, const LoadedScene& loaded) {
  GltfContents out;
  out.scenes = names_of(root, "scenes");
  out.animations = names_of(root, "animations");
  out.scene = loaded.scene;
  if (!root.has("asset") || !root.value()["asset"].is_object()) return out;
  const json& asset = root.value()["asset"];
  if (asset.contains("generator") && asset["generator"].is_string())
    out.generator = asset["generator"].get<std::string>();
  return out;
}

void warn_of_other_scenes(const JsonLocation& root, const GltfContents& contents) {
  if (contents.scenes.size() < 2) return;
  const bool is_default = root.has("scene");
  root.at("scenes").warn(std::to_string(contents.scenes.size()) + " scenes: " + numbered(contents.scenes) +
                         "; read is " + std::to_string(contents.scene) +
                         (is_default ? ", the file's default" : ", the first, since the file names no default") +
                         "; the key scene (--scene) chooses another");
}

}  // namespace clusterbench::scene
