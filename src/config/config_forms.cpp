#include "config/config_forms.h"

#include <algorithm>
#include <filesystem>

#include "config/config_shaders.h"
#include "config/presets/assigner_names.h"
#include "config/presets/preset_library.h"
#include "config/schema/documents.h"
#include "config/schema/schema_reader.h"
#include "core/error.h"
#include "core/text.h"

namespace clusterbench::config {
namespace {

using Json = nlohmann::json;

// Patterns are kept until the list is checked.
bool is_assigner_glob(const std::string& list, const Json& entry) {
  return list == "assigners" && is_glob(entry.get_ref<const std::string&>());
}

// "pixels": a number is a square. A list of exactly two numbers is one size, [width, height]; any other list is an
// axis.
Json square_tiles(Json pixels) {
  const auto is_number = [](const Json& entry) { return entry.is_number(); };
  if (pixels.is_number()) return Json::array({pixels, pixels});
  if (!pixels.is_array() || (pixels.size() == 2 && std::all_of(pixels.begin(), pixels.end(), is_number))) return pixels;
  for (Json& size : pixels)
    if (size.is_number()) size = Json::array({size, size});
  return pixels;
}

// Expands short forms: "aabb" is {"name": "aabb"}, a scene's path is {"path": ...}, tiles of 64 pixels are [64, 64].
Json long_form(Json document, const JsonText& text) {
  if (!document.is_object()) return document;
  const std::pair<const char*, const char*> lists[] = {
      {"scenes", "path"}, {"assigners", "name"}, {"storages", "name"}, {"precision", "packing"}};
  for (const auto& [list, key] : lists) {
    if (!document.contains(list) || !document[list].is_array()) continue;
    for (Json& entry : document[list])
      if (entry.is_string() && !is_assigner_glob(list, entry)) entry = Json{{key, entry}};
  }
  if (document.contains("grids") && document["grids"].is_array())
    for (Json& grid : document["grids"])
      if (const Json::json_pointer pixels("/tiles/pixels"); grid.is_object() && grid.contains(pixels))
        grid[pixels] = square_tiles(grid[pixels]);
  if (document.contains("viewport") && document.contains("viewports"))
    throw Error(text.file, text.where_key("/viewport"), "viewport and viewports exclude each other");
  return document;
}

// Replaces each pattern by the methods that match it and that the list does not name itself.
Json without_globs(const Json& list, const JsonText& text) {
  Json out = Json::array();
  const auto is_named = [](const Json& entries, const std::string& name) {
    return std::any_of(entries.begin(), entries.end(), [&](const Json& entry) {
      return entry == name || (entry.is_object() && entry["name"] == name);
    });
  };
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!list[i].is_string() || !is_glob(list[i].get_ref<const std::string&>())) {
      out.push_back(list[i]);
      continue;
    }
    const std::string where = text.where(child_pointer("/assigners", i));
    for (const std::string& name : matching_assigners(list[i], text.file, where))
      if (!is_named(list, name) && !is_named(out, name)) out.push_back(name);
  }
  return out;
}

constexpr const char* k_own_keys[] = {"grids", "assigners", "storages"};

}  // namespace

bool names_own_clusterings(const Json& document) {
  return std::ranges::any_of(k_own_keys, [&](const char* key) { return document.contains(key); });
}

void drop_own_clusterings(Json& document) {
  for (const char* key : k_own_keys) document.erase(key);
}

Json filled(const JsonText& text) {
  const std::vector<std::string> shaders = add_shaders(text);
  const std::shared_ptr<const Json> schema = shared_config_schema();
  Json document = read_by_schema(*schema, long_form(text.value, text), text);
  if (document.contains("viewport")) {
    document["viewports"] = Json::array({document["viewport"]});
    document.erase("viewport");
  }
  document.erase("$schema");
  if (document["name"].get_ref<const std::string&>().empty())
    document["name"] = printable(std::filesystem::path(text.file).stem().string());
  Json longer = document;
  longer["assigners"] = with_shaders(without_globs(document["assigners"], text), shaders);
  longer = long_form(std::move(longer), text);
  for (const auto& [key, value] : longer.items())  // defaults have short forms, too
    if (value != document[key]) document[key] = read_member_by_schema(*schema, key, value, text);
  if (document.value("as_shipped", false) && !document.contains("presets"))
    throw Error(text.file, text.where("/as_shipped"), "found true without presets; allowed beside presets only");
  if (!document.contains("presets")) return document;
  const auto entries = document["presets"].get<std::vector<std::string>>();
  document["presets"] = named_presets(entries, text.file, text.where("/presets"));
  if (names_own_clusterings(text.value)) return document;
  if (!shaders.empty())
    throw Error(text.file, text.where("/shaders"),
                "runs nowhere: beside presets alone there is no grid of your own; name one (--grid frustum, or grids)");
  drop_own_clusterings(document);
  return document;
}

}  // namespace clusterbench::config
