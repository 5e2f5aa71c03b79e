#include "config/presets.h"

#include <fnmatch.h>

#include <algorithm>

#include "config/assigner_names.h"
#include "config/preset_tables.h"
#include "core/error.h"
#include "core/text.h"

namespace clusterbench::config {
namespace {

using Json = nlohmann::json;

const std::vector<Preset>& all_presets() {
  static const auto all = [] {
    std::vector<Preset> list(published_presets().begin(), published_presets().end());
    list.insert(list.end(), engine_presets().begin(), engine_presets().end());
    return list;
  }();
  return all;
}

// The preset's limit of lights, as a step of a pre-cull; null where it has none.
Json limit_of(const Json& parts) {
  if (parts.contains("pre_cull"))
    for (const Json& step : parts["pre_cull"])
      if (step.is_object() && step.contains("most")) return step["most"];
  return nullptr;
}

bool counts_in_view(const Json& parts) {
  return std::ranges::find(parts["pre_cull"], Json("frustum")) != parts["pre_cull"].end();
}

std::string lights_limit_text(const Json& parts) {
  const Json limit = limit_of(parts);
  if (limit.is_null()) return "";
  std::string text = limit["lights"].dump() + (limit.value("per", "") == "type" ? " of each type" : " lights");
  text += counts_in_view(parts) ? " in view" : " in the scene";
  const std::string keep = limit.value("keep", "first");
  return text + (keep == "first" ? ", the first" : keep == "nearest" ? ", the nearest" : ", those of least depth");
}

std::string cell_limit_text(const Json& parts) {
  if (!parts.contains("storage")) return "";
  const Json& storage = parts["storage"];
  if (storage.contains("cap")) return storage["cap"].dump() + " in a cell";
  if (storage.contains("nodes_per_cell")) return storage["nodes_per_cell"].dump() + " per cell in one pool";
  if (storage.contains("max_entries")) return storage["max_entries"].dump() + " entries";
  return "";
}

}  // namespace

const char* name_of(Evidence evidence) {
  constexpr const char* k_names[] = {"ran", "read", "memory"};
  return k_names[static_cast<int>(evidence)];
}

const char* name_of(AssignsOn place) {
  return place == AssignsOn::cpu ? "cpu" : "gpu";
}

std::span<const Preset> presets() {
  return all_presets();
}

const Preset* find_preset(const std::string& name) {
  const auto found = std::ranges::find_if(presets(), [&](const Preset& preset) { return preset.name == name; });
  return found == presets().end() ? nullptr : &*found;
}

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  for (const Preset& preset : presets()) names.emplace_back(preset.name);
  return names;
}

Json preset_parts(const Preset& preset, Vec2i viewport, bool as_shipped) {
  Json parts = Json::parse(preset.parts);
  if (preset.tiles != nullptr) parts["grid"]["tiles"] = preset.tiles(viewport);
  if (!as_shipped || !preset.has_mistakes()) return parts;
  const Json changes = Json::parse(preset.as_shipped);
  for (const auto& [key, value] : changes.items())
    if (key == "grid")
      parts[key].merge_patch(value);
    else
      parts[key] = value;
  return parts;
}

std::string limit_text(const Preset& preset) {
  const Json parts = Json::parse(preset.parts);
  const std::string lights = lights_limit_text(parts), cell = cell_limit_text(parts);
  return lights + (lights.empty() || cell.empty() ? "" : "; ") + cell;
}

std::uint64_t most_lights(const Preset& preset) {
  const Json limit = limit_of(Json::parse(preset.parts));
  return limit.is_null() ? 0 : limit["lights"].get<std::uint64_t>();
}

std::vector<std::string> named_presets(std::span<const std::string> entries, const std::string& file,
                                       const std::string& where) {
  const std::vector<std::string> all = preset_names();
  std::vector<std::string> names;
  for (const std::string& entry : entries) {
    bool is_any = false;
    for (const std::string& name : all) {
      if (is_glob(entry) ? fnmatch(entry.c_str(), name.c_str(), 0) != 0 : entry != name) continue;
      is_any = true;
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
    if (!is_any)
      throw Error(file, where,
                  "found '" + entry + "'" + did_you_mean(entry, all) + ", allowed: " + joined(all) +
                      ", or a pattern of such names");
  }
  return names;
}

}  // namespace clusterbench::config
