#include "config/config.h"

#include <algorithm>

#include "assign/contract/assigner.h"
#include "config/config_clusterings.h"
#include "config/config_forms.h"
#include "config/config_grids.h"
#include "config/config_plugins.h"
#include "config/config_scenes.h"
#include "config/config_unset.h"
#include "core/error.h"
#include "core/file_text.h"
#include "core/text.h"
#include "core/work_in_order.h"

namespace clusterbench::config {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

std::vector<Vec2i> viewports(const Json& list, const JsonText& text) {
  std::vector<Vec2i> out;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Vec2i size{list[i][0].get<int>(), list[i][1].get<int>()};
    if (std::find(out.begin(), out.end(), size) != out.end())
      throw Error(text.file, text.where(child_pointer("/viewports", i)), "this viewport stands here twice");
    out.push_back(size);
  }
  return out;
}

// A result contains the whole configuration, and JSON is UTF-8. The file itself is valid; file names and flags may not
// be.
void check_utf8(const JsonText& text) {
  const Json flat = text.value.flatten();
  for (const auto& [pointer, value] : flat.items())
    if (value.is_string() && !is_utf8(value.get_ref<const std::string&>()))
      throw Error(text.file, text.file.empty() && !text.flags.contains(pointer) ? "" : text.where(pointer),
                  "'" + value.get<std::string>() + "' is not UTF-8, and no result could name it");
}

// For a wider picture the horizontal field of view would not be exact.
void check_fields_of_view(const Config& config, const JsonText& text) {
  for (std::size_t i = 0; i < config.viewports.size(); ++i) {
    const Vec2i size = config.viewports[i];
    const bool is_too_wide = size.x > scene::k_widest_picture * size.y;
    if (is_too_wide && std::ranges::any_of(config.scenes, [](const SceneRequest& scene) {
          return scene.camera.field_of_view && scene.camera.field_of_view->is_horizontal;
        }))
      throw Error(
          text.file, text.where(child_pointer("/viewports", i)),
          "is " + std::to_string(size.x) + "x" + std::to_string(size.y) +
              ", wider than 64:9, which a horizontal field of view (scenes.*.fov) does not take; name the vertical "
              "one, as in 40v");
  }
}

// The frame cost needs samples with a weight.
void check_ranking(const Json& document, const std::vector<SampleSetRequest>& sets, const JsonText& text) {
  if (document["rank_by"] != "frame_cost") return;
  const Json& weights = document["cost"]["weights"];
  const bool has_cost =
      std::ranges::any_of(sets, [&](const SampleSetRequest& set) { return weights[measure::name_of(set.set)] != 0.0; });
  if (!has_cost)
    throw Error(text.file, text.where("/rank_by"),
                "is frame_cost, and no set of samples with a weight is asked for; add \"samples\": {\"opaque\": {}}");
}

Config read_config(const JsonText& text, const GridChange& preset_grid) {
  check_utf8(text);
  Config config;
  config.file = text.file;
  config.preset_grid = preset_grid;
  config.text = {text.file, nullptr, text.places, text.flags};
  config.resolved = filled(text);
  config.resolved.erase("$schema");
  const Json& document = config.resolved;
  config.name = document["name"].get<std::string>();
  for (std::size_t i = 0; i < document["scenes"].size(); ++i)
    add_scenes(document["scenes"][i], child_pointer("/scenes", i), text, config.scenes);
  for (SceneRequest& scene : config.scenes) scene.camera.jitter_px = jitter_of(document["jitter"]);
  config.viewports = viewports(document["viewports"], text);
  config.pre_culls = pre_culls(document, text);
  config.own_pre_culls = config.pre_culls.size();
  check_fields_of_view(config, text);
  read_clusterings(document, text, preset_grid, config);
  config.precisions = precisions(document, text);
  config.shadow_culls = shadow_culls(document, text);
  config.sample_sets = sample_sets(document);
  check_ranking(document, config.sample_sets, text);
  static_cast<Sections&>(config) = read_sections(document, text);
  config.threads = config.threads_asked ? *config.threads_asked : processors();
  if (config.reading && config.timing.measure) config.reading_sets = reading_sets(*config.reading, config.sample_sets);
  return config;
}

// Beside presets the default grids are not measured, so a flag that changes only these has no effect: an Error.
void check_grids_of_flags(bool has_presets, bool names_own, std::span<const FlagValue> flags) {
  const FlagValue* flag = flag_of_unnamed_grids(flags);
  if (!has_presets || names_own || flag == nullptr) return;
  const std::string key = flag->value.substr(0, flag->value.find('='));
  const bool is_far = key.ends_with("slices.far") || key.ends_with("slices/far");
  throw Error(
      "", flag->shown(),
      std::string("changes grids of the configuration, and not those of presets, which are their engines'; ") +
          (is_far ? "their slices end with the camera's far plane: --set 'scenes.*.far=METRES' sets it; " : "") +
          "a grid of your own beside the presets is named first: --grid frustum; the grid of a preset is "
          "changed in a configuration: `clusterbench list presets` prints it");
}

// Reads the configuration with the changes by flags. Presets run alone if neither the file nor a flag names a
// clustering.
Config read_changed(JsonText text, std::span<const FlagValue> flags, const Json& defaults,
                    const GridChange& preset_grid) {
  load_plugins(text, flags);
  const GridsFrom grids = text.value.contains("grids") ? GridsFrom::file : GridsFrom::defaults;
  const bool names_own = names_own_clusterings(text.value);
  const UnsetDefaults unset(text, flags);
  for (const auto& [key, value] : defaults.items())
    if (text.value.is_object() && !text.value.contains(key)) text.value[key] = value;
  JsonText as_written = text;
  if (text.value.contains("presets") && !names_own) drop_own_clusterings(as_written.value);
  unset.add_to(as_written.value);
  Config config = read_config(as_written, flags.empty() ? preset_grid : GridChange{});
  if (flags.empty()) return config;
  Json document = std::move(config.resolved);
  if (!document.contains("grids")) {
    const Json presets = document["presets"];
    text.value.erase("presets");
    document = filled(text);
    document["presets"] = presets;
  }
  JsonText changed = changed_by_flags(document, grids, text.file, flags);
  check_grids_of_flags(changed.value.contains("presets"), names_own, flags);
  if (changed.value.contains("presets") && !names_own && !name_clusterings(flags)) drop_own_clusterings(changed.value);
  unset.add_to(changed.value);
  if (grids == GridsFrom::defaults && changed.value.contains("grids")) {
    const Json whole = filled(changed)["grids"], usable = usable_default_grids(whole);
    if (usable != whole) changed.value["grids"] = usable;
  }
  return read_config(changed, preset_grid);
}

}  // namespace

Config changed(const Config& config, const Json& patch) {
  JsonText text = config.text;
  text.value = config.resolved;
  text.value.merge_patch(patch);
  return read_config(text, config.preset_grid);
}

Config with_presets_on_processor(const Config& config) {
  const auto on_device = [](const MethodRequest& method) { return assign::find_assigner(method.name)->on_device; };
  const auto own_end = config.assigners.begin() + static_cast<std::ptrdiff_t>(config.own_assigners);
  if (config.device.empty() || std::none_of(own_end, config.assigners.end(), on_device)) return config;
  if (const auto own = std::find_if(config.assigners.begin(), own_end, on_device); own != own_end)
    throw Error(config.file.string(), "assigners",
                own->name +
                    " runs on the device, and beside it presets would, too, whose lists are counted on the "
                    "processor here; measure it without presets");
  return changed(config, {{"device", ""}});
}

Config parse_config(const std::string& text, const fs::path& file, std::span<const FlagValue> flags,
                    const Json& defaults, const GridChange& preset_grid) {
  return read_changed(parse_json_text(text, file.string()), flags, defaults, preset_grid);
}

Config load_config(const fs::path& path, std::span<const FlagValue> flags, const Json& defaults,
                   const GridChange& preset_grid) {
  return parse_config(file_text(path), path, flags, defaults, preset_grid);
}

Config default_config(const std::vector<fs::path>& scenes, std::span<const FlagValue> flags, const Json& defaults,
                      const GridChange& preset_grid) {
  JsonText text;
  text.value = document_of_scenes(scenes);
  return read_changed(std::move(text), flags, defaults, preset_grid);
}

}  // namespace clusterbench::config
