#include "config/config.h"

#include <algorithm>
#include <set>

#include "config/config_clusterings.h"
#include "config/config_forms.h"
#include "config/config_grids.h"
#include "config/config_scenes.h"
#include "config/config_unset.h"
#include "core/error.h"
#include "core/file_text.h"
#include "core/text.h"

namespace clusterbench::config {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

view::Packing packing_of(const std::string& name) {
  return *std::find_if(std::begin(view::k_packings), std::end(view::k_packings),
                       [&](view::Packing packing) { return name == view::packing_name(packing); });
}

std::vector<PrecisionRequest> precisions(const Json& list, const JsonText& text) {
  std::vector<PrecisionRequest> out;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string where = text.where(child_pointer("/precision", i));
    for (const Json& object : expand_all_axes(list[i])) {
      const PrecisionRequest request{packing_of(object["packing"].get<std::string>()), object["inflate"].get<bool>()};
      if (request.inflate && !request.is_lossy())
        throw Error(text.file, where,
                    "float32 loses nothing that assigners do not pad for themselves; inflate what "
                    "half or unorm16 loses");
      if (std::find(out.begin(), out.end(), request) != out.end())
        throw Error(text.file, where, "'" + request.label() + "' stands here twice");
      out.push_back(request);
    }
  }
  return out;
}

depth::TexelBound texel_bound_of(const std::string& name) {
  return name == depth::name_of(depth::TexelBound::proven) ? depth::TexelBound::proven : depth::TexelBound::sampled;
}

std::vector<ShadowCullRequest> shadow_culls(const Json& document, const JsonText& text) {
  std::vector<ShadowCullRequest> out;
  if (!document.contains("shadow_cull")) return out;
  for (const Json& object : expand_all_axes(document["shadow_cull"])) {
    const ShadowCullRequest request{
        {object["resolution"].get<int>(), texel_bound_of(object["texels"].get<std::string>()),
         object["near_m"].get<double>()},
        object["bias_m"].get<double>()};
    if (std::ranges::find(out, request) != out.end())
      throw Error(text.file, text.where("/shadow_cull"), "has a list with the same value twice");
    out.push_back(request);
  }
  return out;
}

std::optional<SharedFrustaRequest> shared_frusta(const Json& document) {
  if (!document.contains("shadow_frusta")) return std::nullopt;
  const Json& frusta = document["shadow_frusta"];
  return SharedFrustaRequest{frusta["apart_m"].get<double>(), frusta["turned_deg"].get<double>(),
                             frusta["growth"].get<double>()};
}

std::optional<StabilityRequest> stability_request(const Json& stability) {
  if (stability.is_null()) return std::nullopt;
  return StabilityRequest{stability["steps"].get<int>(), stability["step_mm"].get<double>(),
                          stability["step_deg"].get<double>(), stability["window"].get<int>()};
}

// The index of a name among the first `count` values of an enumeration.
template <class Named>
Named named(const std::string& name, int count) {
  int i = 0;
  while (i + 1 < count && name != measure::name_of(static_cast<Named>(i))) ++i;
  return static_cast<Named>(i);
}

// Every logarithm with every depth read.
std::optional<LookupRequest> lookup_request(const Json& lookup) {
  if (lookup.is_null()) return std::nullopt;
  LookupRequest request{lookup["samples"].get<int>(), {}};
  for (const std::string logarithm : lookup["logarithms"])
    for (const std::string depth : lookup["depths"])
      request.ways.push_back({named<measure::Logarithm>(logarithm, measure::k_logarithm_count),
                              named<measure::DepthRead>(depth, measure::k_depth_read_count)});
  return request;
}

std::optional<DetailsRequest> details_request(const Json& details) {
  if (details.is_null()) return std::nullopt;
  DetailsRequest request;
  request.lists = details["lists"].get<bool>();
  request.max_bytes = details["max_bytes"].get<std::size_t>();
  const Json& frames = details["frames"];
  if (frames.is_number()) {
    request.choice = DetailsRequest::Choice::evenly;
    request.count = frames.get<int>();
  } else if (frames.is_array()) {
    request.choice = DetailsRequest::Choice::listed;
    const auto once = frames.get<std::set<int>>();
    request.frames.assign(once.begin(), once.end());
  }
  return request;
}

std::vector<LimitRule> limit_rules(const Json& list, const JsonText& text) {
  std::vector<LimitRule> rules;
  for (std::size_t i = 0; i < list.size(); ++i)
    rules.push_back(limit_rule(list[i].get<std::string>(), text.file, text.where(child_pointer("/limits/fail_if", i))));
  return rules;
}

// In the order of measure::SampleSet.
std::vector<SampleSetRequest> sample_sets(const Json& document) {
  std::vector<SampleSetRequest> sets;
  if (const int count = document["shading"]["samples"].get<int>(); count > 0)
    sets.push_back({.set = measure::SampleSet::volume, .count = count});
  for (std::size_t i = 0; i < measure::k_sample_set_count; ++i) {
    const auto set = static_cast<measure::SampleSet>(i);
    const auto found = document["samples"].find(measure::name_of(set));
    if (found == document["samples"].end()) continue;
    SampleSetRequest request{.set = set};
    request.count = found->value("count", request.count);
    request.divisor = found->value("divisor", request.divisor);
    request.layers = found->value("layers", request.layers);
    if (const Json ground = found->value("ground", Json()); !ground.is_null())
      request.ground = ground.is_number() ? GroundRequest{false, ground.get<double>()} : GroundRequest{true, 0.0};
    if (found->contains("froxels"))
      for (int axis = 0; axis < 3; ++axis)
        request.froxels[axis] = (*found)["froxels"][static_cast<std::size_t>(axis)].get<int>();
    sets.push_back(request);
  }
  return sets;
}

void read_settings(const Json& document, Config& config) {
  config.threads = document["threads"].get<int>();
  config.seed = document["seed"].get<std::uint64_t>();
  config.check_accuracy = document["accuracy"]["check"].get<bool>();
  const Json& most_pairs = document["accuracy"]["most_pairs"];
  if (most_pairs.is_number()) config.most_pairs = most_pairs.get<std::uint64_t>();
  config.sample_sets = sample_sets(document);
  config.stability = stability_request(document["stability"]);
  config.lookup = lookup_request(document["lookup"]);
  config.details = details_request(document["details"]);
  const Json& all_pairs = document["limits"]["all_pairs"];
  if (all_pairs.is_number()) config.limits.all_pairs = all_pairs.get<std::uint64_t>();
  config.limits.memory_mib = document["limits"]["memory_mib"].get<std::uint64_t>();
  config.limits.allows_no_lights = document["limits"]["allow_no_lights"].get<bool>();
  config.limits.allows_changed_lights = document["limits"]["allow_changed_lights"].get<bool>();
  const Json& dropped = document["limits"]["dropped_pairs"];
  config.limits.dropped_pairs = dropped.is_null() ? std::nullopt : std::optional(dropped.get<std::uint64_t>());
  const Json& timing = document["timing"];
  config.timing = {timing["measure"].get<bool>(), timing["rounds"].get<int>(),   timing["min_time_ms"].get<double>(),
                   timing["frames"].get<int>(),   timing["launches"].get<int>(), timing["cold"].get<bool>()};
  config.allocation = {document["allocation"]["margin"].get<double>(), document["allocation"]["warn_at"].get<double>()};
}

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
  config.text = text;
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
  config.precisions = precisions(document["precision"], text);
  config.shadow_culls = shadow_culls(document, text);
  config.shared_frusta = shared_frusta(document);
  read_settings(document, config);
  check_ranking(document, config.sample_sets, text);
  config.limits.fail_if = limit_rules(document["limits"]["fail_if"], text);
  if (const Json& baseline = document["limits"]["baseline"]; baseline.is_string())
    config.limits.baseline = path_in(text, baseline.get<std::string>(), text.where("/limits/baseline"));
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
  Json document = config.resolved;
  if (!document.contains("grids")) {
    text.value.erase("presets");
    document = filled(text);
    document["presets"] = config.resolved["presets"];
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

std::string PrecisionRequest::label() const {
  return std::string(view::packing_name(packing)) + (inflate ? "+inflate" : "");
}

Config changed(const Config& config, const Json& patch) {
  JsonText text = config.text;
  text.value = config.resolved;
  text.value.merge_patch(patch);
  return read_config(text, config.preset_grid);
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
