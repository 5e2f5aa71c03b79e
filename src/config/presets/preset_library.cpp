#include "config/presets/preset_library.h"

#include <algorithm>

#include "assign/contract/assigner.h"
#include "config/presets/assigner_names.h"
#include "config/presets/preset_file.h"
#include "config/presets/preset_text.h"
#include "config/presets/preset_tiles.h"
#include "core/error.h"
#include "core/text.h"
#include "core/wildcards.h"

namespace clusterbench::config {
namespace {

using Json = nlohmann::json;

const std::vector<Preset>& all_presets() {
  static const auto all = [] {
    std::vector<Preset> list;
    for (const PresetText& file : preset_texts())
      list.push_back(read_preset(std::string(file.text), "configs/presets/" + std::string(file.name) + ".json"));
    return list;
  }();
  return all;
}

// The preset's limit of lights, a step of its pre-cull; null without a limit.
Json limit_of(const Preset& preset) {
  if (preset.pre_cull)
    for (const result::Json& step : *preset.pre_cull)
      if (step.is_object() && step.contains("most")) return step["most"];
  return nullptr;
}

bool counts_in_view(const Preset& preset) {
  return std::ranges::find(*preset.pre_cull, result::Json("frustum")) != preset.pre_cull->end();
}

std::string lights_limit_text(const Preset& preset) {
  const Json limit = limit_of(preset);
  if (limit.is_null()) return "";
  std::string text = limit["lights"].dump() + (limit.value("per", "") == "type" ? " of each type" : " lights");
  text += counts_in_view(preset) ? " in view" : " in the scene";
  const std::string keep = limit.value("keep", "first");
  return text + (keep == "first" ? ", the first" : keep == "nearest" ? ", the nearest" : ", those of least depth");
}

std::string cell_limit_text(const Preset& preset) {
  if (!preset.storage) return "";
  const result::Json& storage = *preset.storage;
  if (storage.contains("cap")) return storage["cap"].dump() + " in a cell";
  if (storage.contains("nodes_per_cell")) return storage["nodes_per_cell"].dump() + " per cell in one pool";
  if (storage.contains("max_entries")) return storage["max_entries"].dump() + " entries";
  return "";
}

// The parts {"grid": {...}, "assigner": {...}, ...} of a preset or of its changes.
template <class Record>
Json parts_of(const Record& record) {
  Json parts = Json::object();
  const result::Json all = result::to_json(record);
  for (const char* key : {"grid", "assigner", "storage", "pre_cull"})
    if (all.contains(key)) parts[key] = all[key];
  return parts;
}

bool takes_device_method(const Preset& preset, PresetForm form) {
  const bool is_as_shipped = form.as_shipped && preset.as_shipped && preset.as_shipped->assigner;
  return form.on_device && preset.on_device && !is_as_shipped;
}

void take_device_method(const Preset& preset, Json& parts) {
  parts["assigner"] = preset.on_device->assigner;
  const assign::AssignerDescriptor* method = assign::find_assigner(parts["assigner"]["name"].get<std::string>());
  if (method != nullptr && !method->answers(assign::Answer::lists)) parts.erase("storage");
}

}  // namespace

std::span<const Preset> presets() {
  return all_presets();
}

const Preset* find_preset(const std::string& name) {
  if (name.empty()) return nullptr;  // asked of every case: reading all presets takes milliseconds
  const auto found = std::ranges::find_if(presets(), [&](const Preset& preset) { return preset.name == name; });
  return found == presets().end() ? nullptr : &*found;
}

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  for (const PresetText& file : preset_texts()) names.emplace_back(file.name);
  return names;
}

Json preset_parts(const Preset& preset, Vec2i viewport, PresetForm form) {
  Json parts = parts_of(preset);
  if (preset.tiles_by) parts["grid"]["tiles"] = find_tiles_by(*preset.tiles_by)(viewport);
  if (takes_device_method(preset, form)) take_device_method(preset, parts);
  if (!form.as_shipped || !preset.as_shipped) return parts;
  const Json changes = parts_of(*preset.as_shipped);
  for (const auto& [key, value] : changes.items())
    if (key == "grid")
      parts[key].merge_patch(value);
    else
      parts[key] = value;
  return parts;
}

std::string limit_text(const Preset& preset) {
  const std::string lights = lights_limit_text(preset), cell = cell_limit_text(preset);
  return lights + (lights.empty() || cell.empty() ? "" : "; ") + cell;
}

std::uint64_t most_lights(const Preset& preset) {
  const Json limit = limit_of(preset);
  return limit.is_null() ? 0 : limit["lights"].get<std::uint64_t>();
}

std::vector<std::string> named_presets(std::span<const std::string> entries, const std::string& file,
                                       const std::string& where) {
  const std::vector<std::string> all = preset_names();
  std::vector<std::string> names;
  for (const std::string& entry : entries) {
    bool is_any = false;
    for (const std::string& name : all) {
      if (is_glob(entry) ? !matches_wildcards(entry, name) : entry != name) continue;
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
