#include "config/config.h"

#include <algorithm>
#include <set>

#include "assign/contract/storage.h"
#include "config/assigner_names.h"
#include "config/config_grids.h"
#include "config/config_scenes.h"
#include "config/documents.h"
#include "config/grid_json.h"
#include "config/json_text.h"
#include "config/pre_cull_json.h"
#include "config/presets.h"
#include "config/schema_reader.h"
#include "core/error.h"
#include "core/file_text.h"
#include "core/text.h"

namespace clusterbench::config {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

assign::ParamValue param_value(const Json& value) {
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_number()) return value.get<double>();
  return value.get<std::string>();
}

MethodRequest method(const Json& object, std::span<const assign::ParamSpec> specs) {
  std::map<std::string, assign::ParamValue> given;
  for (const auto& [key, value] : object.items())
    if (key != "name") given[key] = param_value(value);
  return {object["name"].get<std::string>(), assign::Params(specs, given)};
}

std::span<const assign::ParamSpec> assigner_params(const std::string& name) {
  return assign::find_assigner(name)->params;
}
std::span<const assign::ParamSpec> storage_params(const std::string& name) {
  return assign::find_storage(name)->params;
}

template <class SpecsOf>
std::vector<MethodRequest> methods(const Json& list, const char* key, const JsonText& text, SpecsOf specs_of) {
  std::vector<MethodRequest> out;
  for (std::size_t i = 0; i < list.size(); ++i) {
    for (const Json& object : expand_all_axes(list[i])) {
      MethodRequest request = method(object, specs_of(object["name"].get<std::string>()));
      const bool twice = std::any_of(out.begin(), out.end(), [&](const MethodRequest& earlier) {
        return earlier.name == request.name && earlier.params.values() == request.params.values();
      });
      const std::string pointer = std::string("/") + key;
      const bool as_written = text.value.contains(key) && text.value[key].size() == list.size();  // not from a pattern
      if (twice)
        throw Error(text.file, text.where(as_written ? child_pointer(pointer, i) : pointer),
                    "'" + request.label() + "' stands here twice with the same parameters");
      out.push_back(std::move(request));
    }
  }
  return out;
}

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

std::vector<cull::PreCullSpec> pre_culls(const Json& document, const JsonText& text) {
  if (!document.contains("pre_cull")) return {{}};
  std::vector<cull::PreCullSpec> out;
  const Json& list = document["pre_cull"];
  for (std::size_t i = 0; i < list.size(); ++i) {
    cull::PreCullSpec spec = pre_cull_spec(list[i]);
    if (std::find(out.begin(), out.end(), spec) != out.end())
      throw Error(text.file, text.where(child_pointer("/pre_cull", i)), "'" + spec.label() + "' stands here twice");
    out.push_back(std::move(spec));
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

bool names_own_clusterings(const Json& document) {
  return std::ranges::any_of(k_own_keys, [&](const char* key) { return document.contains(key); });
}

void drop_own_clusterings(Json& document) {
  for (const char* key : k_own_keys) document.erase(key);
}

// Fills in defaults and expands short forms, those of the defaults as well. Presets alone have no default clusterings
// beside them.
Json filled(const JsonText& text) {
  const Json schema = config_schema();
  Json document = read_by_schema(schema, long_form(text.value, text), text);
  if (document.contains("viewport")) {
    document["viewports"] = Json::array({document["viewport"]});
    document.erase("viewport");
  }
  document.erase("$schema");
  if (document["name"].get_ref<const std::string&>().empty())
    document["name"] = printable(fs::path(text.file).stem().string());
  document["assigners"] = without_globs(document["assigners"], text);
  document = read_by_schema(schema, long_form(document, text), text);
  if (document.value("as_shipped", false) && !document.contains("presets"))
    throw Error(text.file, text.where("/as_shipped"), "found true without presets; allowed beside presets only");
  if (!document.contains("presets")) return document;
  const auto entries = document["presets"].get<std::vector<std::string>>();
  document["presets"] = named_presets(entries, text.file, text.where("/presets"));
  if (!names_own_clusterings(text.value)) drop_own_clusterings(document);
  return document;
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

// The index of the first element equal to `item`, which is appended if there is none.
template <class Item, class IsEqual>
std::size_t index_in(std::vector<Item>& list, const Item& item, IsEqual is_equal) {
  const auto found = std::ranges::find_if(list, [&](const Item& other) { return is_equal(other, item); });
  const auto index = static_cast<std::size_t>(found - list.begin());
  if (found == list.end()) list.push_back(item);
  return index;
}

bool is_same_grid(const grid::GridSpec& a, const grid::GridSpec& b) {
  return grid_identity(a) == grid_identity(b);
}
bool is_same_method(const MethodRequest& a, const MethodRequest& b) {
  return a.name == b.name && a.params.values() == b.params.values();
}

// Appends the engine's own steps to each pre-cull of the configuration.
void add_engine_steps(const Json& parts, const Json& document, Config& config, PresetChoice& choice) {
  if (!parts.contains("pre_cull")) return;
  const std::vector<cull::Step> own = pre_cull_spec(document["pre_cull"][0]).steps;
  for (std::size_t i = 0; i < config.own_pre_culls; ++i) {
    cull::PreCullSpec spec = config.pre_culls[i];
    for (const cull::Step& step : own)
      if (std::ranges::find(spec.steps, step) == spec.steps.end()) spec.steps.push_back(step);
    choice.pre_culls.push_back(index_in(config.pre_culls, spec, std::equal_to<>()));
  }
}

// Replaces members of a preset's grid; new tiles replace the old ones completely, so that there are never two sizes.
Json changed_grid(Json grid, const GridChange& change) {
  if (change.grid.contains("tiles")) grid.erase("tiles");
  grid.merge_patch(change.grid);
  return grid;
}

void add_preset(const Preset& preset, std::size_t viewport, const Json& schema, bool as_shipped,
                const GridChange& preset_grid, Config& config) {
  Json parts = preset_parts(preset, config.viewports[viewport], as_shipped);
  parts["grid"] = changed_grid(parts["grid"], preset_grid);
  JsonText text;
  text.file = "preset " + preset.name;
  for (const auto& [pointer, flag] : preset_grid.flags) text.flags["/grids/0" + pointer] = flag.shown();
  text.value["scenes"] = Json::array({{{"path", "any.glb"}}});
  text.value["grids"] = Json::array({parts["grid"]});
  text.value["assigners"] = Json::array({parts["assigner"]});
  if (parts.contains("storage")) text.value["storages"] = Json::array({parts["storage"]});
  if (parts.contains("pre_cull")) text.value["pre_cull"] = Json::array({parts["pre_cull"]});
  const Json document = read_by_schema(schema, text.value, text);
  PresetChoice choice{preset.name, viewport, 0, 0, std::nullopt};
  choice.assigner = index_in(
      config.assigners, methods(document["assigners"], "assigners", text, assigner_params).front(), is_same_method);
  if (parts.contains("storage"))
    choice.storage = index_in(config.storages, methods(document["storages"], "storages", text, storage_params).front(),
                              is_same_method);
  add_engine_steps(parts, document, config, choice);
  for (const grid::GridSpec& spec : grid_specs(document["grids"], text)) {
    choice.grid = index_in(config.grids, spec, is_same_grid);
    config.presets.push_back(choice);
  }
}

void read_clusterings(const Json& document, const JsonText& text, const GridChange& preset_grid, Config& config) {
  if (document.contains("grids")) {
    config.grids = grid_specs(document["grids"], text);
    config.assigners = methods(document["assigners"], "assigners", text, assigner_params);
    config.storages = methods(document["storages"], "storages", text, storage_params);
  }
  config.own_grids = config.grids.size();
  config.own_assigners = config.assigners.size();
  config.own_storages = config.storages.size();
  if (!document.contains("presets")) return;
  const Json schema = config_schema();
  for (std::size_t viewport = 0; viewport < config.viewports.size(); ++viewport)
    for (const Json& name : document["presets"])
      add_preset(*find_preset(name.get<std::string>()), viewport, schema, document.value("as_shipped", false),
                 preset_grid, config);
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

// For runs whose limits the user did not choose (scenes on the command line, presets): they should end within two
// minutes on two cores.
constexpr std::uint64_t k_usual_most_pairs = 4'000'000;
constexpr int k_usual_frames = 30;
constexpr double k_usual_lights = 1200.0;

// Defaults for settings that neither the file nor a flag has. Presets are ranked by their cost at visible surfaces: a
// ray per 16 x 16 pixels.
class UnsetDefaults {
 public:
  UnsetDefaults(const JsonText& text, std::span<const FlagValue> flags)
      : has_scenes_only_(text.file.empty()),
        names_surfaces_(names_surfaces(text.value) || names_key(flags, "samples[./]opaque") || removes_samples(flags)),
        names_accuracy_(text.value.contains("accuracy") || names_key(flags, "accuracy")) {}

  void add_to(Json& document) const {
    const bool has_presets = document.contains("presets");
    if (!names_accuracy_ && (has_scenes_only_ || has_presets)) document["accuracy"]["most_pairs"] = k_usual_most_pairs;
    if (!has_presets) return;
    if (!names_surfaces_) add_surfaces(document);
  }

 private:
  static void add_surfaces(Json& document) {
    Json& samples = document["samples"];
    if (samples.is_null() || (samples.is_object() && !samples.contains("opaque")))
      samples["opaque"] = {{"divisor", 16}};
  }
  // "samples": {} requests no set.
  static bool names_surfaces(const Json& document) {
    return document.contains("samples") && document["samples"].is_object() &&
           (document["samples"].empty() || document["samples"].contains("opaque"));
  }
  static bool removes_samples(std::span<const FlagValue> flags) {
    return std::ranges::any_of(
        flags, [](const FlagValue& flag) { return flag.name == "--set" && flag.value == "samples={}"; });
  }

  bool has_scenes_only_, names_surfaces_, names_accuracy_;
};

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

std::string param_text(const assign::ParamSpec& spec, const assign::ParamValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  const double number = std::get<double>(value);
  return spec.whole ? Json(static_cast<std::int64_t>(number)).dump() : Json(number).dump();
}

}  // namespace

std::string MethodRequest::label() const {
  const assign::AssignerDescriptor* assigner = assign::find_assigner(name);
  const assign::StorageDescriptor* storage = assign::find_storage(name);
  std::span<const assign::ParamSpec> specs;
  if (assigner != nullptr) specs = assigner->params;
  if (assigner == nullptr && storage != nullptr) specs = storage->params;
  std::string inner;
  for (const assign::ParamSpec& spec : specs) {
    const auto value = params.values().find(spec.name);
    if (value == params.values().end() || value->second == spec.default_value) continue;
    inner += (inner.empty() ? "" : ",") + spec.name + "=" + param_text(spec, value->second);
  }
  return inner.empty() ? name : name + "(" + inner + ")";
}

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
  Json list = Json::array();
  for (const fs::path& path : scenes)
    list.push_back({{"path", path.string()}, {"frames", {{"most", k_usual_frames}, {"lights", k_usual_lights}}}});
  const Json document{{"name", scenes.size() == 1 ? printable(scenes.front().stem().string()) : "scenes"},
                      {"scenes", list},
                      {"timing", {{"rounds", 15}, {"min_time_ms", 2}, {"frames", 4}}}};
  JsonText text;
  text.value = document;
  return read_changed(std::move(text), flags, defaults, preset_grid);
}

}  // namespace clusterbench::config
