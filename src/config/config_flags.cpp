#include "config/config_flags.h"

#include <algorithm>
#include <array>
#include <regex>
#include <set>

#include "config/config_plugins.h"
#include "config/config_shaders.h"
#include "config/presets/assigner_names.h"
#include "config/presets/preset_library.h"
#include "config/schema/documents.h"
#include "core/error.h"
#include "core/json_document.h"
#include "gpu/user_shaders/shader_method.h"

namespace clusterbench::config {
namespace {

using Json = nlohmann::json;

[[noreturn]] void refuse(const FlagValue& flag, const std::string& what) {
  throw Error("", flag.shown(), what);
}

// Splits "a,[b,c],{d,e}" at commas outside of brackets and quotes; with parameters also "a(b,c),d" outside of theirs.
std::vector<std::string> split(const std::string& text, bool with_parameters = false) {
  std::vector<std::string> parts(1);
  int depth = 0;
  bool quoted = false;
  const std::string opening = with_parameters ? "[{(" : "[{", closing = with_parameters ? "]})" : "]}";
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' && (i == 0 || text[i - 1] != '\\')) quoted = !quoted;
    if (!quoted && opening.find(c) != std::string::npos) ++depth;
    if (depth > k_deepest_json)
      throw Error("", "--set", "a value nested deeper than " + std::to_string(k_deepest_json) + " levels");
    if (!quoted && closing.find(c) != std::string::npos) --depth;
    if (c == ',' && depth == 0 && !quoted)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

// JSON, or a word without quotes; several make a list.
Json value_of(const std::string& text) {
  Json list = Json::array();
  for (const std::string& part : split(text)) {
    Json value = Json::parse(part, nullptr, false);
    list.push_back(value.is_discarded() ? Json(part) : std::move(value));
  }
  return list.size() == 1 ? list.front() : list;
}

// Whether the schema allows only a list there: --set precision=half is a list of one.
bool wants_list(const std::string& pointer) {
  static const std::shared_ptr<const Json> shared = shared_config_schema();
  const Json& schema = *shared;
  const std::string key = pointer.substr(0, pointer.find('/', 1));
  const Json::json_pointer top("/properties" + key), below_top("/properties" + pointer.substr(key.size()));
  const Json* part = schema.contains(top) ? &schema[top] : nullptr;
  if (part != nullptr && pointer != key) part = part->contains(below_top) ? &(*part)[below_top] : nullptr;
  return part != nullptr && part->value("type", Json()) == "array";
}

// A configuration, and the flag behind each changed key.
class FlaggedConfig {
 public:
  explicit FlaggedConfig(JsonText& text) : text_(text) {}

  const std::string& file() const { return text_.file; }
  Json& root() { return text_.value; }
  Json& operator[](const char* key) { return text_.value[key]; }
  void mark(const std::string& pointer, const FlagValue& flag) { text_.flags[pointer] = flag.shown(); }

  // Sets the values that `steps` lead to from `at`, whose pointer is `pointer`. A step is a key, the index of an entry,
  // or "*" for each entry that has the next key. Returns the number of values set.
  int set(Json& at, const std::string& pointer, std::span<const std::string> steps, const FlagValue& flag,
          const Json& value) {
    if (steps.empty()) {
      at = wants_list(pointer) && !value.is_array() ? Json::array({value}) : value;
      mark(pointer, flag);
      return 1;
    }
    if (at.is_array()) return set_in_list(at, pointer, steps, flag, value);
    if (at.is_null()) at = Json::object();  // an optional part that is off, such as "stability"
    if (!at.is_object()) refuse(flag, pointer + " has no keys");
    const std::string member = child_pointer(pointer, steps.front());
    if (!at.contains(steps.front())) mark(member, flag);
    return set(at[steps.front()], member, steps.subspan(1), flag, value);
  }

 private:
  static bool has_step(const Json& entry, const std::string& step) {
    if (!entry.is_array()) return entry.contains(step);
    const Json number = Json::parse(step, nullptr, false);
    return step == "*" || (number.is_number_unsigned() && number < entry.size());
  }

  int set_in_list(Json& list, const std::string& pointer, std::span<const std::string> steps, const FlagValue& flag,
                  const Json& value) {
    const Json number = Json::parse(steps.front(), nullptr, false);
    const bool is_entry = number.is_number_unsigned() && number < list.size();
    if (!is_entry && steps.front() != "*")
      refuse(flag, pointer + " has " + std::to_string(list.size()) +
                       " entries: takes a number from 0, or * for all, not '" + steps.front() + "'");
    int count = 0;
    for (std::size_t i = 0; i < list.size(); ++i) {
      // All scenes accept the same keys, even those that are not present yet.
      const bool is_meant =
          is_entry ? number == i : steps.size() == 1 || pointer == "/scenes" || has_step(list[i], steps[1]);
      if (is_meant) count += set(list[i], child_pointer(pointer, i), steps.subspan(1), flag, value);
    }
    return count;
  }

  JsonText& text_;
};

bool has_tiles(const Json& grid) {
  return grid["kind"] == "frustum" || grid["kind"] == "distance";
}

// Keeps the configuration's grids of these kinds; a kind that it does not have is added with its defaults.
void choose_grids(FlaggedConfig& document, const FlagValue& flag) {
  Json chosen = Json::array();
  for (const std::string& kind : split(flag.value)) {
    const std::size_t before = chosen.size();
    for (const Json& grid : document["grids"])
      if (grid["kind"] == kind) chosen.push_back(grid);
    if (chosen.size() > before) continue;
    document.mark(child_pointer("/grids", before), flag);
    chosen.push_back({{"kind", kind}});
  }
  document["grids"] = chosen;
}

// Pixels per tile, and tiles per screen.
struct TileSizes {
  Json pixels = Json::array(), counts = Json::array();
};

TileSizes tile_sizes(const FlagValue& flag) {
  static const std::regex form("([0-9]{1,9})(?:x([0-9]{1,9}))?(px|t)?");
  TileSizes sizes;
  for (const std::string& part : split(flag.value)) {
    std::smatch found;
    const bool is_size = std::regex_match(part, found, form);
    const bool is_count = is_size && found[3] == "t";
    if (!is_size || (is_count && !found[2].matched))
      refuse(flag,
             "'" + part + "' is no tile size; takes 64 or 64x32 (pixels of a tile), or 16x9t (tiles across and down)");
    const int width = std::stoi(found[1]), height = found[2].matched ? std::stoi(found[2]) : width;
    (is_count ? sizes.counts : sizes.pixels).push_back({width, height});
  }
  return sizes;
}

void choose_tiles(FlaggedConfig& document, const FlagValue& flag) {
  const TileSizes sizes = tile_sizes(flag);
  Json grids = Json::array();
  for (const Json& grid : document["grids"]) {
    if (!has_tiles(grid)) grids.push_back(grid);
    for (const auto& [key, axis] : {std::pair{"pixels", &sizes.pixels}, std::pair{"count", &sizes.counts}}) {
      if (!has_tiles(grid) || axis->empty()) continue;
      document.mark(child_pointer("/grids", grids.size()) + "/tiles", flag);
      grids.push_back(grid);
      grids.back()["tiles"] = {{key, *axis}};
    }
  }
  if (std::none_of(grids.begin(), grids.end(), has_tiles)) refuse(flag, "no grid has tiles; add --grid frustum");
  document["grids"] = grids;
}

void set_of_slices(FlaggedConfig& document, const char* key, const FlagValue& flag) {
  Json& grids = document["grids"];
  if (std::none_of(grids.begin(), grids.end(), has_tiles)) refuse(flag, "no grid has slices; add --grid frustum");
  const std::string steps[] = {"slices", key};
  for (std::size_t i = 0; i < grids.size(); ++i)
    if (has_tiles(grids[i])) document.set(grids[i], child_pointer("/grids", i), steps, flag, value_of(flag.value));
}

void choose_slices(FlaggedConfig& document, const FlagValue& flag) {
  set_of_slices(document, "count", flag);
}

void choose_scheme(FlaggedConfig& document, const FlagValue& flag) {
  set_of_slices(document, "scheme", flag);
}

// Flags that change existing grids.
bool changes_existing_grids(const FlagValue& flag) {
  return flag.name == "--tiles" || flag.name == "--slices" || flag.name == "--scheme";
}

void choose_viewports(FlaggedConfig& document, const FlagValue& flag) {
  static const std::regex form("([0-9]{1,9})x([0-9]{1,9})");
  Json viewports = Json::array();
  for (const std::string& part : split(flag.value)) {
    std::smatch found;
    if (!std::regex_match(part, found, form))
      refuse(flag, "'" + part + "' is no image size; takes WIDTHxHEIGHT, as in 1920x1080");
    viewports.push_back({std::stoi(found[1]), std::stoi(found[2])});
  }
  document["viewports"] = viewports;
  document.mark("/viewports", flag);
}

// "gpu-tiled(tiles=occupied)", as in names of cases, is {"name": "gpu-tiled", "tiles": "occupied"}. Null without
// parameters.
Json assigner_with_parameters(const std::string& part, const FlagValue& flag) {
  const std::size_t open = part.find('(');
  if (open == std::string::npos || !part.ends_with(')')) return {};
  Json entry{{"name", part.substr(0, open)}};
  for (const std::string& parameter : split(part.substr(open + 1, part.size() - open - 2))) {
    const std::size_t equals = parameter.find('=');
    std::string key = parameter.substr(0, equals);
    key.erase(0, key.find_first_not_of(' '));
    if (equals == std::string::npos || key.empty() || entry.contains(key))
      refuse(flag, "'" + parameter +
                       "' is no parameter, or one that is there already; takes NAME(PARAMETER=VALUE,...), as in " +
                       "gpu-tiled(tiles=occupied)");
    entry[key] = value_of(parameter.substr(equals + 1));
  }
  return entry;
}

// Without parameters the configuration's own entries of that name, which keep theirs.
void choose_assigners(FlaggedConfig& document, const FlagValue& flag) {
  Json chosen = Json::array();
  const auto add_once = [&](const Json& entry) {
    if (std::find(chosen.begin(), chosen.end(), entry) == chosen.end()) chosen.push_back(entry);
  };
  const auto add_named = [&](const std::string& name) {
    bool has_own = false;
    for (const Json& own : document["assigners"]) {
      if (own["name"] != name) continue;
      add_once(own);
      has_own = true;
    }
    if (!has_own) add_once({{"name", name}});
  };
  for (const std::string& part : split(flag.value, true)) {
    if (const Json entry = assigner_with_parameters(part, flag); !entry.is_null())
      add_once(entry);
    else
      std::ranges::for_each(is_glob(part) ? matching_assigners(part, "", flag.shown()) : std::vector{part}, add_named);
  }
  document["assigners"] = chosen;
  document.mark("/assigners", flag);
}

// It is loaded already.
void add_plugin(FlaggedConfig& document, const FlagValue& flag) {
  const Json path = plugin_path_for(document.file(), flag.value);
  Json& plugins = document["plugins"];
  if (std::find(plugins.begin(), plugins.end(), path) != plugins.end()) return;
  document.mark(child_pointer("/plugins", plugins.size()), flag);
  plugins.push_back(path);
}

void choose_presets(FlaggedConfig& document, const FlagValue& flag) {
  document["presets"] = named_presets(split(flag.value), "", flag.shown());
  document.mark("/presets", flag);
}

void set_key(FlaggedConfig& document, const std::vector<std::string>& steps, const FlagValue& flag, const Json& value) {
  Json& root = document.root();
  if (document.set(root, "", steps, flag, value) == 0) refuse(flag, "no entry has this key");
}

void set_field_of_view(FlaggedConfig& document, const FlagValue& flag) {
  set_key(document, {"scenes", "*", "fov"}, flag, Json(flag.value));
}

// An index from 0, or a name; "12" may be either, depending on the names in the file.
void set_scene(FlaggedConfig& document, const FlagValue& flag) {
  set_key(document, {"scenes", "*", "scene"}, flag, Json(flag.value));
}

void set_animation(FlaggedConfig& document, const FlagValue& flag) {
  set_key(document, {"scenes", "*", "animation"}, flag, Json(flag.value));
}

void set_cutoff(FlaggedConfig& document, const FlagValue& flag) {
  set_key(document, {"scenes", "*", "range_rule", "cutoff_lux"}, flag, value_of(flag.value));
}

void set_max_range(FlaggedConfig& document, const FlagValue& flag) {
  set_key(document, {"scenes", "*", "range_rule", "max_range"}, flag, value_of(flag.value));
}

void set_rounds(FlaggedConfig& document, const FlagValue& flag) {
  set_key(document, {"timing", "rounds"}, flag, value_of(flag.value));
}

void set_launches(FlaggedConfig& document, const FlagValue& flag) {
  set_key(document, {"timing", "launches"}, flag, value_of(flag.value));
}

void set_threads(FlaggedConfig& document, const FlagValue& flag) {
  set_key(document, {"threads"}, flag, value_of(flag.value));
}

void set_device(FlaggedConfig& document, const FlagValue& flag) {
  set_key(document, {"device"}, flag, flag.value);
}

void add_shader(FlaggedConfig& document, const FlagValue& flag) {
  gpu::add_shader_method(flag.value);  // now, so that patterns of --assigner find it
  const std::string path = shader_path_for(document.file(), flag.value);
  Json& shaders = document["shaders"];
  if (std::find(shaders.begin(), shaders.end(), path) != shaders.end()) return;
  document.mark(child_pointer("/shaders", shaders.size()), flag);
  shaders.push_back(path);
}

// Decodes a step of a JSON pointer (RFC 6901): ~1 is a slash, ~0 a tilde.
std::string unescaped(const std::string& step, const FlagValue& flag) {
  std::string out;
  for (std::size_t i = 0; i < step.size(); ++i) {
    const char next = i + 1 < step.size() ? step[i + 1] : ' ';
    if (step[i] != '~') {
      out += step[i];
      continue;
    }
    if (next != '0' && next != '1') refuse(flag, "in a JSON pointer ~ stands before 0 (~) or 1 (/) only");
    out += next == '0' ? '~' : '/';
    ++i;
  }
  return out;
}

void add_budget(FlaggedConfig& document, const FlagValue& flag) {
  Json& budgets = document["limits"]["fail_if"];
  document.mark(child_pointer("/limits/fail_if", budgets.size()), flag);
  budgets.push_back(flag.value);
}

// "a.b.0.c", or as a JSON pointer, "/a/b/0/c".
std::vector<std::string> steps_of(const std::string& key, const FlagValue& flag) {
  constexpr std::size_t k_most_steps = 16;  // deeper than any key
  const bool is_pointer = key.starts_with('/');
  const auto depth = static_cast<std::size_t>(std::count(key.begin(), key.end(), is_pointer ? '/' : '.'));
  if (depth > k_most_steps)
    throw Error("", flag.name,
                "a key with " + std::to_string(depth) + " steps; at most " + std::to_string(k_most_steps));
  std::vector<std::string> steps(1);
  for (const char c : key.substr(is_pointer ? 1 : 0))
    if (c == (is_pointer ? '/' : '.'))
      steps.emplace_back();
    else
      steps.back() += c;
  if (is_pointer)
    for (std::string& step : steps) step = unescaped(step, flag);
  return steps;
}

void set_any(FlaggedConfig& document, const FlagValue& flag) {
  const std::size_t equals = flag.value.find('=');
  if (equals == 0 || equals == std::string::npos) refuse(flag, "takes KEY=VALUE, as in --set timing.frames=4");
  std::vector<std::string> steps = steps_of(flag.value.substr(0, equals), flag);
  Json value = value_of(flag.value.substr(equals + 1));
  if (steps == std::vector<std::string>{"viewport"}) {
    steps = {"viewports"};
    value = Json::array({value});
  }
  set_key(document, steps, flag, value);
}

struct FlagRow {
  ConfigFlag flag;
  void (*apply)(FlaggedConfig& document, const FlagValue& flag);
};

// In the order of their application.
constexpr FlagRow k_rows[] = {
    {{"--grid", "KIND[,KIND]: only grids of these kinds; one that the configuration lacks comes with its defaults"},
     choose_grids},
    {{"--tiles", "SIZE[,SIZE]: pixels of a tile, 64 or 64x32; or tiles across and down, 16x9t"}, choose_tiles},
    {{"--slices", "N[,N]: how many slices depth or distance is cut into"}, choose_slices},
    {{"--scheme", "NAME[,NAME]: how it is cut: exponential, exponential-first, linear, ...; docs/grids-and-lookups.md"},
     choose_scheme},
    {{"--viewport", "WxH[,WxH]: image sizes in pixels, as 1920x1080"}, choose_viewports},
    {{"--shader",
      "FILE, repeatable: your own compute shaders as a method (docs/shaders.md), measured beside the others", true},
     add_shader},
    {{"--assigner",
      "NAME[,NAME]: only these assigners; * and ? stand for any letters, as in '*-fast'; parameters: "
      "'exact-fast(threads=4)'"},
     choose_assigners},
    {{"--plugin", "[ID=]FILE, repeatable: a plug-in, whose methods can then be named (docs/plugins.md)", true},
     add_plugin},
    {{"--preset",
      "NAME[,NAME]: clusterings as engines have them, alone or beside the configuration's own; see `list presets`"},
     choose_presets},
    {{"--fov", "DEGREESh or DEGREESv: the cameras' field of view across the picture, as 90h, or up and down, as 60v"},
     set_field_of_view},
    {{"--scene", "NAME or number: which of a glTF file's scenes; without, its default"}, set_scene},
    {{"--animation", "NAME or number: the only one of a file's animations that plays; without, all together"},
     set_animation},
    {{"--cutoff-lux", "LUX: illuminance at which a light without a range ends"}, set_cutoff},
    {{"--max-range", "METRES: the longest range that such a light gets"}, set_max_range},
    {{"--rounds", "N: timed rounds over all cases of a group"}, set_rounds},
    {{"--launches", "N: processes that measure one after the other; intervals hold between them"}, set_launches},
    {{"--threads", "N: threads that count (default: all processors); results do not depend on it"}, set_threads},
    {{"--device",
      "NAME, UUID or number: the device of methods that run on one, as `clusterbench list devices` shows it; presets "
      "of engines that assign on the GPU then take such methods"},
     set_device},
    {{"--fail-if", "BUDGET, repeatable: fail where a case exceeds it, as in 'longest > 128' or 'bytes > 200000'", true},
     add_budget},
    {{"--set", "KEY=VALUE[,VALUE], repeatable: any key of the configuration, as in 'grids.*.slices.far=200,500'", true},
     set_any},
};

// Whether a flag set this key of a grid's slices, directly or as part of a larger value.
bool is_set_by_flag(const JsonText& text, const std::string& grid, const std::string& key) {
  const auto is_set = [&](const std::string& pointer) {
    const auto found = text.flags.find(pointer);
    return found != text.flags.end() && found->second.starts_with("--set");
  };
  return text.flags.contains(grid + "/slices/" + key) || is_set(grid + "/slices") || is_set(grid) || is_set("/grids");
}

// Drops keys of `slices` that none of its schemes uses and that no flag set: a flag chose another scheme.
void drop_unused_slice_keys(JsonText& text) {
  const std::shared_ptr<const Json> schema = shared_config_schema();
  const Json& properties = (*schema)["definitions"]["slices"]["properties"];
  Json& grids = text.value["grids"];
  for (std::size_t i = 0; i < grids.size(); ++i) {
    if (!grids[i].contains("slices") || !grids[i]["slices"].contains("scheme")) continue;
    Json& slices = grids[i]["slices"];
    const Json& scheme = slices["scheme"];
    for (const auto& [key, property] : properties.items()) {
      const Json users = property.value("x-used-by", Json::array());
      const auto is_user = [&](const Json& name) { return std::find(users.begin(), users.end(), name) != users.end(); };
      const bool is_used = scheme.is_array() ? std::any_of(scheme.begin(), scheme.end(), is_user) : is_user(scheme);
      if (!users.empty() && !is_used && !is_set_by_flag(text, child_pointer("/grids", i), key)) slices.erase(key);
    }
  }
}

// The defaults have several grids per kind, with different tiles and slices; with tiles or slices from flags one of
// each kind is enough.
void keep_one_of_each_kind(Json& grids) {
  Json kept = Json::array();
  for (const Json& grid : grids)
    if (std::none_of(kept.begin(), kept.end(),
                     [&](const Json& kept_grid) { return kept_grid["kind"] == grid["kind"]; }))
      kept.push_back(grid);
  grids = kept;
}

// Grids can be equal after a flag has set the key in which they differed.
void drop_repeated(Json& list) {
  Json once = Json::array();
  std::set<Json> earlier;
  for (Json& entry : list)
    if (earlier.insert(entry).second) once.push_back(std::move(entry));
  list = std::move(once);
}

}  // namespace

std::span<const ConfigFlag> config_flags() {
  static const auto flags = [] {
    std::array<ConfigFlag, std::size(k_rows)> all{};
    std::transform(std::begin(k_rows), std::end(k_rows), all.begin(), [](const FlagRow& row) { return row.flag; });
    return all;
  }();
  return flags;
}

std::string FlagValue::shown() const {
  constexpr std::size_t k_longest = 100;
  const std::string whole = text();
  return whole.size() > k_longest ? whole.substr(0, k_longest) + "..." : whole;
}

bool names_key(std::span<const FlagValue> values, const std::string& key) {
  const std::regex set_key("/?" + key + "[./=].*");
  return std::ranges::any_of(
      values, [&](const FlagValue& flag) { return flag.name == "--set" && std::regex_match(flag.value, set_key); });
}

bool name_clusterings(std::span<const FlagValue> values) {
  const auto is_own = [](const FlagValue& flag) {
    return flag.name == "--grid" || flag.name == "--assigner" || changes_existing_grids(flag);
  };
  return std::ranges::any_of(values, is_own) || names_key(values, "(grids|assigners|storages)");
}

const FlagValue* flag_of_unnamed_grids(std::span<const FlagValue> values) {
  static const std::regex member("/?grids[./](\\*|[0-9]+)[./].*");
  const FlagValue* found = nullptr;
  for (const FlagValue& flag : values) {
    const bool is_member = flag.name == "--set" && std::regex_match(flag.value, member);
    if (!is_member && name_clusterings(std::span(&flag, 1))) return nullptr;
    if (is_member && found == nullptr) found = &flag;
  }
  return found;
}

bool changes_grid(const FlagValue& flag) {
  return flag.name == "--grid" || changes_existing_grids(flag) || names_key(std::span(&flag, 1), "grids");
}

GridChange grid_change(std::span<const FlagValue> values) {
  GridChange change;
  const auto put = [&](const std::string& pointer, const FlagValue& flag, const Json& value) {
    change.grid[Json::json_pointer(pointer)] = value;
    change.flags.insert_or_assign(pointer, flag);
  };
  for (const FlagValue& flag : values) {
    if (flag.name == "--grid") put("/kind", flag, value_of(flag.value));
    if (flag.name == "--slices") put("/slices/count", flag, value_of(flag.value));
    if (flag.name == "--scheme") put("/slices/scheme", flag, value_of(flag.value));
    if (flag.name == "--tiles") {
      const TileSizes sizes = tile_sizes(flag);
      if (!sizes.pixels.empty()) put("/tiles/pixels", flag, sizes.pixels);
      if (!sizes.counts.empty()) put("/tiles/count", flag, sizes.counts);
    }
    if (flag.name != "--set" || !changes_grid(flag)) continue;
    const std::size_t equals = flag.value.find('=');
    const std::vector<std::string> steps = steps_of(flag.value.substr(0, equals), flag);
    if (equals == std::string::npos || steps.size() < 3)
      refuse(flag, "takes a key of a grid, as in grids.*.slices.count=24");
    std::string pointer;
    for (const std::string& step : std::span(steps).subspan(2)) pointer = child_pointer(pointer, step);
    put(pointer, flag, value_of(flag.value.substr(equals + 1)));
  }
  return change;
}

JsonText changed_by_flags(const Json& document, GridsFrom grids, const std::string& file,
                          std::span<const FlagValue> values) {
  JsonText text;
  text.file = file;
  text.value = document;
  FlaggedConfig changed(text);
  if (grids == GridsFrom::defaults && std::any_of(values.begin(), values.end(), changes_existing_grids))
    keep_one_of_each_kind(text.value["grids"]);
  for (const FlagRow& row : k_rows)
    for (const FlagValue& flag : values)
      if (flag.name == row.flag.name) row.apply(changed, flag);
  if (text.value["grids"].is_array()) {
    drop_unused_slice_keys(text);
    drop_repeated(text.value["grids"]);
  }
  return text;
}

}  // namespace clusterbench::config
