#include "report/engine_settings.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "report/columns.h"
#include "report/json_values.h"
#include "report/size_words.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

// What a setting has to have room for.
enum class Needed : std::uint8_t { lights_in_view, lights_of_type, lights_in_scene, longest_list, entries };

struct LimitSetting {
  const char* name;  // as it stands in the engine
  Needed needed;
  std::uint64_t standard, least, most;  // as the engine comes, and what it takes
  std::uint64_t multiple = 1;
  bool is_constant = false;  // compiled in: nothing to set, and frames can still have more
};

struct EngineRow {
  const char *preset, *version;
  const char* grid;  // the call or member that the grid is set with: X, Y, Z stand for the cells, P for a tile's pixels
  std::vector<LimitSetting> limits;
  const char* beyond;  // what happens beyond the limit
};

constexpr std::uint64_t k_any = 0xffffffff;

// From public code and documentation of the versions named.
const std::vector<EngineRow>& engine_rows() {
  static const std::vector<EngineRow> rows{
      {"godot",
       "Godot 4, Project Settings",
       "",
       {{"rendering/limits/cluster_builder/max_clustered_elements", Needed::lights_of_type, 512, 32, 8192, 32}},
       "of each type (omni lights, spot lights, decals, reflection probes) elements beyond it are not drawn"},
      {"playcanvas",
       "PlayCanvas engine 2, scene.lighting (LightingParams)",
       "scene.lighting.cells = new pc.Vec3(X, Y, Z)",
       {{"scene.lighting.maxLightsPerCell", Needed::longest_list, 255, 1, 255},
        {"lights of a frame, which 8 bits number", Needed::lights_in_view, 255, 1, 255, 1, true}},
       "a full cell takes no more lights, and a frame no more than 255"},
      {"three-js",
       "three.js r187, examples/jsm/lighting/ClusteredLighting.js",
       "new ClusteredLighting(maxLights, tileSize = P, zSlices = Z, maxLightsPerCluster)",
       {{"maxLights", Needed::lights_in_scene, 1024, 1, k_any},
        {"maxLightsPerCluster", Needed::longest_list, 64, 1, k_any}},
       "lights of the scene beyond maxLights are not drawn, in view or not; a full cluster keeps the farthest lights"},
      {"bevy",
       "Bevy 0.19, GlobalClusterSettings and ClusterConfig of a camera",
       "ClusterConfig::XYZ { dimensions: UVec3::new(X, Y, Z), .. }",
       {{"GlobalClusterSettings::view_cluster_bindings_max_indices", Needed::entries, 16384, 1, k_any}},
       "with storage buffers lists grow; without, tiles grow in the next frames until lists fit (dynamic_resizing)"},
      {"bevy-gpu",
       "Bevy 0.19, GlobalClusterGpuSettings",
       "ClusterConfig::XYZ { dimensions: UVec3::new(X, Y, Z), .. }",
       {{"GlobalClusterSettings::gpu_clustering.initial_index_list_capacity", Needed::entries, 0, 1, k_any}},
       "the list grows after a few frames that lack lights"},
      {"ogre-next",
       "OGRE-Next 2.3 and later, SceneManager",
       "setForwardClustered(true, X, Y, Z, lightsPerCell, decalsPerCell, cubemapProbesPerCell, minDistance, "
       "maxDistance)",
       {{"lightsPerCell", Needed::longest_list, 96, 1, k_any}},
       "a full cell takes no more lights"},
      {"unity-urp",
       "Unity URP 14 and later, package com.unity.render-pipelines.universal-config",
       "",
       {{"MAX_VISIBLE_LIGHT_COUNT_DESKTOP (ShaderConfig.cs.hlsl) and k_MaxVisibleLightCountDesktop (ShaderConfig.cs)",
         Needed::lights_in_view, 256, 1, 256}},
       "lights beyond it are not drawn; on mobile platforms the limits are 32 and 16"},
  };
  return rows;
}

struct Constant {
  const char *name, *what;
};
constexpr Constant k_constants[] = {
    {"filament", "CONFIG_MAX_LIGHT_COUNT (256 lights in view) is compiled in"},
    {"babylon", "its lists are bit masks of all lights"},
    {"unity-hdrp", "its counts are packed into bits"},
    {"wicked", "its 256 entities are compiled in"},
    {"stride", "its lists grow"},
};

const EngineRow* row_of_engine(const std::string& name) {
  const auto found =
      std::ranges::find(engine_rows(), name, [](const EngineRow& row) { return std::string(row.preset); });
  return found == engine_rows().end() ? nullptr : &*found;
}

bool is_of_lists(Needed needed) {
  return needed == Needed::longest_list || needed == Needed::entries;
}

// Lists of frames in which a limit took lights away are shorter than those that the lights need.
bool has_lists_behind_limit(const Json& result_case) {
  const Json* steps = value_at(result_case, "/pre_cull/steps");
  return steps != nullptr && std::ranges::any_of(*steps, [](const Json& step) {
           return step["label"].get_ref<const std::string&>().starts_with("most(") &&
                  number_at(step, "/removed/max").value_or(1.0) > 0.0;
         });
}

std::optional<double> most_of_any_type(const Json& result_case) {
  const Json* by_type = value_at(result_case, "/lights_in_view/max_by_type");
  if (by_type == nullptr) return number_at(result_case, "/lights_in_view/max");
  double most = 0.0;
  for (const Json& lights : *by_type) most = std::max(most, lights.get<double>());
  return most;
}

std::optional<double> seen_in_case(const Json& result_case, Needed needed) {
  if (is_of_lists(needed) && has_lists_behind_limit(result_case)) return {};
  switch (needed) {
    case Needed::lights_in_view:
      return number_at(result_case, "/lights_in_view/max");
    case Needed::lights_of_type:
      return most_of_any_type(result_case);
    case Needed::lights_in_scene:
      return number_at(result_case, "/lights");
    case Needed::longest_list:
      return number_at(result_case, "/occupancy/lights_per_cell/max");
    case Needed::entries:
      break;
  }
  return number_at(result_case, "/buffers/index_entries/high_water");
}

// The most that was seen of it, over all cameras; none where the result does not say.
std::optional<std::uint64_t> most_seen(const SizedStructure& structure, Needed needed) {
  std::uint64_t most = 0;
  for (const Json* result_case : structure.cases) {
    const std::optional<double> value = seen_in_case(*result_case, needed);
    if (!value) return {};
    most = std::max(most, static_cast<std::uint64_t>(*value));
  }
  return most;
}

// Of the level: no list and no view has more.
std::optional<std::uint64_t> most_lights(const SizedStructure& structure) {
  std::uint64_t most = 0;
  for (const Json* result_case : structure.cases) {
    const std::optional<double> lights = number_at(*result_case, "/lights");
    if (!lights) return {};
    most = std::max(most, static_cast<std::uint64_t>(*lights));
  }
  return structure.found ? std::max(most, structure.found->lights) : most;
}

// The most that a search found, where it looked for that.
std::optional<std::uint64_t> most_found(const SizedStructure& structure, Needed needed) {
  if (!structure.found || !is_of_lists(needed) || structure.buffers.empty()) return {};
  const SizedBuffer& lists = structure.buffers.front();
  const bool has_room_per_cell = (*structure.cases.front())["storage"].get<std::string>().starts_with("fixed");
  if (!lists.found || has_room_per_cell != (needed == Needed::longest_list)) return {};
  if (!has_room_per_cell) return lists.found;
  std::uint64_t cells = 1;
  for (const Json& axis : (*structure.cases.front())["grid"]["cells"]) cells *= axis.get<std::uint64_t>();
  return *lists.found / std::max<std::uint64_t>(1, cells);
}

struct SettingValue {
  const LimitSetting* setting;
  std::optional<std::uint64_t> seen, found;
  std::uint64_t value = 0;   // to set
  std::uint64_t wanted = 0;  // before the engine's largest value
  bool is_all = false;       // as many as the level has

  std::uint64_t needed() const { return std::max(seen.value_or(0), found.value_or(0)); }
  bool is_too_much() const { return needed() > setting->most; }
};

SettingValue value_of(const LimitSetting& setting, const SizedStructure& structure, const AllocationRules& rules) {
  SettingValue out{&setting, most_seen(structure, setting.needed), most_found(structure, setting.needed)};
  auto with_margin = static_cast<std::uint64_t>(std::ceil(static_cast<double>(out.needed()) * rules.margin));
  if (setting.needed == Needed::lights_in_scene)
    with_margin = std::max(with_margin, most_lights(structure).value_or(0));
  if (const auto lights = most_lights(structure);
      lights && setting.needed != Needed::entries && with_margin >= *lights) {
    with_margin = *lights;
    out.is_all = true;
  }
  out.wanted = (std::max(with_margin, setting.least) + setting.multiple - 1) / setting.multiple * setting.multiple;
  out.value = std::min(out.wanted, setting.most);
  return out;
}

const char* unit_of(Needed needed) {
  switch (needed) {
    case Needed::lights_in_view:
      return "lights in view";
    case Needed::lights_of_type:
      return "lights of one type in view";
    case Needed::lights_in_scene:
      return "lights in the scene";
    case Needed::longest_list:
      return "lights in the longest list";
    case Needed::entries:
      break;
  }
  return "entries in all lists";
}

std::string grid_text(const EngineRow& row, const Json& grid) {
  std::string out = row.grid;
  const auto put = [&](const std::string& letter, const std::string& value) {
    for (std::size_t at = 0; (at = out.find(letter, at)) != std::string::npos; at += value.size()) {
      const bool is_alone = (at == 0 || std::isalnum(static_cast<unsigned char>(out[at - 1])) == 0) &&
                            (at + 1 == out.size() || std::isalnum(static_cast<unsigned char>(out[at + 1])) == 0);
      if (is_alone) out.replace(at, 1, value);
    }
  };
  const char* letters[] = {"X", "Y", "Z"};
  for (std::size_t axis = 0; axis < 3; ++axis) put(letters[axis], grid["cells"][axis].dump());
  if (const Json* pixels = value_at(grid, "/tiles/pixels")) put("P", (*pixels)[0].dump());
  return out;
}

// What the setting is set to, and what the engine comes with.
std::string value_text(const SettingValue& value) {
  const LimitSetting& setting = *value.setting;
  if (setting.is_constant) return "at most " + std::to_string(setting.most) + ", compiled in";
  const std::string standard = std::to_string(setting.standard);
  std::string out = std::to_string(value.value);
  if (value.is_too_much()) return out + ", and that is NOT ENOUGH";
  if (setting.standard > 0 && value.needed() > 0)
    out += value.value <= setting.standard ? " (the engine's own " + standard + " is enough)"
                                           : " (the engine comes with " + standard + ")";
  return out;
}

std::string search_text(const SettingValue& value, const SizedStructure& structure) {
  const Needed needed = value.setting->needed;
  if (value.found) return std::to_string(*value.found) + " " + unit_of(needed);
  if (structure.found && !structure.found->refusal.empty()) return "not searched: " + structure.found->refusal;
  if (structure.found && !is_of_lists(needed)) return "not looked for: the search makes lists long";
  return "not searched (--worst-case)";
}

// Beyond what the engine takes.
std::string lost_text(const SettingValue& value) {
  const std::uint64_t over = value.needed() - value.setting->most;
  const std::string most = "TOO MUCH: the engine takes at most " + std::to_string(value.setting->most);
  if (value.setting->needed == Needed::longest_list)
    return most + "; the longest list loses " + number_of(over, "light");
  if (value.setting->needed == Needed::entries)
    return most + "; such a frame loses " + std::to_string(over) + " entries";
  return most + "; such a frame loses " + number_of(over, "light") +
         (value.setting->needed == Needed::lights_of_type ? " of that type" : "");
}

std::string setting_lines(const SettingValue& value, const SizedStructure& structure, const AllocationRules& rules) {
  const LimitSetting& setting = *value.setting;
  std::string out = std::string("  ") + setting.name + ": ";
  if (!value.seen)
    return out + "unknown: the result does not say how many " + unit_of(setting.needed) +
           (is_of_lists(setting.needed) ? " there are without the engine's own limit on lights" : "") +
           "; count anew: clusterbench size LEVEL --engine NAME\n";
  out += value_text(value) + "\n    the most seen: " + std::to_string(*value.seen) + " " + unit_of(setting.needed) +
         " in " + number_of(structure.frames(), "frame") + "\n";
  if (setting.needed != Needed::lights_in_scene)
    out += "    the most found by a search: " + search_text(value, structure) + "\n";
  if (!setting.is_constant)
    out += (value.is_all ? std::string("    all lights of the level") : "    x " + text("%g", rules.margin)) +
           (setting.multiple > 1 ? ", up to a multiple of " + std::to_string(setting.multiple) : std::string()) +
           (!value.is_too_much() && value.wanted > setting.most
                ? "; the engine takes at most " + std::to_string(setting.most) + ", less room than asked for"
                : "") +
           "\n";
  return out + (value.is_too_much() ? "    " + lost_text(value) + "\n" : "");
}

// What to do with the settings: where frames need more than the engine takes, setting them does not help.
std::string advice_text(const EngineRow& row, const std::vector<SizedStructure>& structures,
                        const AllocationRules& rules) {
  bool is_too_much = false, is_known = true;
  for (const SizedStructure& structure : structures)
    for (const LimitSetting& setting : row.limits) {
      const SettingValue value = value_of(setting, structure, rules);
      is_too_much |= value.is_too_much();
      is_known &= value.seen.has_value();
    }
  if (std::ranges::any_of(structures, saw_no_light))
    return "Do not set these values: they hold for frames without lights. Give cameras that see some.\n";
  if (is_too_much)
    return "With these values the engine still loses lights, where it says TOO MUCH: fewer or smaller lights, or "
           "another clustering; `clusterbench run` with the preset says what pixels lose.\n";
  if (!is_known) return "Set the values that are known; measure again when levels or lights change.\n";
  return "Set these values; measure again when levels or lights change.\n";
}

}  // namespace

std::vector<std::string> engines_with_settings() {
  std::vector<std::string> names;
  for (const EngineRow& row : engine_rows()) names.emplace_back(row.preset);
  return names;
}

void check_engine(const std::string& name) {
  if (row_of_engine(name) != nullptr) return;
  for (const Constant& constant : k_constants)
    if (name == constant.name)
      throw Error("", "--engine",
                  name + " has no setting for it: " + constant.what + "; `clusterbench run --preset " + name +
                      "` says what frames lose");
  const std::vector<std::string> names = engines_with_settings();
  throw Error("", "--engine",
              "'" + name + "' is no engine whose limits can be set" + did_you_mean(name, names) + "; there are " +
                  joined(names));
}

std::string engine_settings_text(const std::string& engine, const std::vector<SizedStructure>& structures,
                                 const AllocationRules& rules) {
  const EngineRow& row = *row_of_engine(engine);
  std::string out;
  for (const SizedStructure& structure : structures) {
    out += shown(structure.name) + "\n  " + row.version + "\n";
    if (const std::string grid = grid_text(row, (*structure.cases.front())["grid"]); !grid.empty())
      out += "  " + grid + "\n";
    for (const LimitSetting& setting : row.limits)
      out += setting_lines(value_of(setting, structure, rules), structure, rules);
    if (saw_no_light(structure)) out += "  " + no_light_text() + "\n";
    out += std::string("  beyond the limit: ") + row.beyond + "\n";
    for (const std::string& note : grid_notes(structure)) out += "  grid: " + shown(note) + "\n";
    out += "\n";
  }
  return out + advice_text(row, structures, rules);
}

Json engine_settings_json(const std::string& engine, const SizedStructure& structure, const AllocationRules& rules) {
  const EngineRow& row = *row_of_engine(engine);
  Json out{{"engine", engine},
           {"version", row.version},
           {"grid", grid_text(row, (*structure.cases.front())["grid"])},
           {"limits", Json::array()}};
  for (const LimitSetting& setting : row.limits) {
    const SettingValue value = value_of(setting, structure, rules);
    Json entry{{"name", setting.name}, {"needed", unit_of(setting.needed)}};
    entry["seen"] = value.seen ? Json(*value.seen) : Json();
    entry["found"] = value.found ? Json(*value.found) : Json();
    entry["value"] = value.seen && !setting.is_constant ? Json(value.value) : Json();
    entry["most"] = setting.most == k_any ? Json() : Json(setting.most);
    entry["is_too_much"] = value.is_too_much();
    if (value.is_too_much()) entry["lost"] = value.needed() - setting.most;
    out["limits"].push_back(entry);
  }
  return out;
}

}  // namespace clusterbench::report
