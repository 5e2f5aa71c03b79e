#include "report/size_report/engine_limits.h"

#include <algorithm>
#include <cmath>

#include "config/presets/preset_library.h"
#include "core/text.h"
#include "result/at.h"

namespace clusterbench::report {
namespace {

using result::Case;
using result::LightsInView;
using result::number;

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

// If a limit removed lights, the lists of those frames are shorter than the lights need.
bool has_lists_behind_limit(const Case& result_case) {
  const auto takes_lights = [](const result::PreCullStep& step) {
    return step.label.starts_with("most(") &&
           number<&result::PreCullStep::removed, &result::MeanMax::max>(step).value_or(1.0) > 0.0;
  };
  return result_case.pre_cull && std::ranges::any_of(result_case.pre_cull->steps, takes_lights);
}

std::optional<double> most_of_any_type(const Case& result_case) {
  if (!result_case.lights_in_view) return {};
  const result::LightsByType& most = result_case.lights_in_view->max_by_type;
  return static_cast<double>(std::max({most.point, most.spot, most.box}));
}

// With room for all: if a pool is full, its need. If tiles grew because lists were full: in the requested tiles, before
// they grew.
std::optional<double> entries_in(const Case& result_case) {
  if (result_case.react)
    return number<&Case::react, &result::Reaction::fixed, &result::FitSide::index_entries>(result_case);
  const result::Buffers& buffers = result_case.buffers;
  const std::uint64_t kept = buffers.index_entries.high_water;
  const bool is_full = buffers.overflow.dropped_pairs > 0 || buffers.overflow.cells > 0;
  const bool has_need = buffers.each && !buffers.each->empty();
  return static_cast<double>(is_full && has_need ? std::max(kept, buffers.each->front().high_water) : kept);
}

double per_cell(double entries, const Case& result_case) {
  double cells = 1.0;
  for (const std::uint64_t axis : result_case.grid.cells) cells *= std::max(1.0, static_cast<double>(axis));
  return std::ceil(entries / cells);
}

std::optional<double> seen_in_case(const Case& result_case, Needed needed) {
  if (is_of_lists(needed) && has_lists_behind_limit(result_case)) return {};
  switch (needed) {
    case Needed::lights_in_view:
      return number<&Case::lights_in_view, &LightsInView::max>(result_case);
    case Needed::lights_of_type:
      return most_of_any_type(result_case);
    case Needed::lights_in_scene:
      return number<&Case::lights>(result_case);
    case Needed::longest_list:
      return number<&Case::occupancy, &result::Occupancy::lights_per_cell, &result::LightsPerCell::max>(result_case);
    case Needed::entries_per_cell:
      if (const std::optional<double> entries = entries_in(result_case)) return per_cell(*entries, result_case);
      return {};
    case Needed::entries:
      break;
  }
  return entries_in(result_case);
}

// The maximum over all cameras; none if the result does not record it.
std::optional<std::uint64_t> most_seen(const SizedStructure& structure, Needed needed) {
  std::uint64_t most = 0;
  for (const Case* result_case : structure.cases) {
    const std::optional<double> value = seen_in_case(*result_case, needed);
    if (!value) return {};
    most = std::max(most, static_cast<std::uint64_t>(*value));
  }
  return most;
}

// Upper bound by the level: no list and no view has more; of one type if the setting is for one. Lights added by a
// search can be of any type.
std::optional<std::uint64_t> most_lights(const SizedStructure& structure, Needed needed) {
  std::uint64_t most = 0;
  for (const Case* result_case : structure.cases) {
    if (!result_case->lights) return {};
    most = std::max(most, *result_case->lights);
  }
  std::uint64_t added = 0;
  for (const FoundFrame& found : structure.searches)
    added = std::max(added, found.lights - std::min(most, found.lights));
  const bool is_of_type = needed == Needed::lights_of_type && structure.lights_of_type;
  return (is_of_type ? *structure.lights_of_type : most) + added;
}

// The largest finding of a search for it.
std::optional<std::uint64_t> most_found(const SizedStructure& structure, Needed needed) {
  std::optional<std::uint64_t> most;
  for (const FoundFrame& found : structure.searches)
    if (found.refusal.empty() && found.measure == measure_of(needed)) most = std::max(most.value_or(0), found.value);
  if (most && needed == Needed::entries_per_cell)
    most = static_cast<std::uint64_t>(per_cell(static_cast<double>(*most), *structure.cases.front()));
  return most;
}

}  // namespace

// From public code and documentation of the versions that the presets model.
const std::vector<EngineRow>& engine_rows() {
  static const std::vector<EngineRow> rows{
      {"godot",
       "Project Settings",
       "",
       "",
       {},
       {{"rendering/limits/cluster_builder/max_clustered_elements", Needed::lights_of_type, 512, 32, 8192, 32}},
       "of each type (omni lights, spot lights, decals, reflection probes) elements beyond it are not drawn"},
      {"playcanvas",
       "scene.lighting (LightingParams)",
       "scene.lighting.cells = new pc.Vec3(X, Y, Z)",
       "",
       {"/cells"},
       {{"scene.lighting.maxLightsPerCell", Needed::longest_list, 255, 1, 255},
        {"lights of a frame, which 8 bits number", Needed::lights_in_view, 255, 1, 255, 1, true}},
       "a full cell takes no more lights, and a frame no more than 255"},
      {"three-js",
       "examples/jsm/lighting/ClusteredLighting.js",
       "new ClusteredLighting(maxLights, tileSize = P, zSlices = Z, maxLightsPerCluster)",
       "",
       {"/tiles/pixels", "/slices/count"},
       {{"maxLights", Needed::lights_in_scene, 1024, 1, k_any},
        {"maxLightsPerCluster", Needed::longest_list, 64, 1, k_any}},
       "lights of the scene beyond maxLights are not drawn, in view or not; a full cluster keeps the farthest lights"},
      {"bevy",
       "GlobalClusterSettings and ClusterConfig of a camera",
       "ClusterConfig::XYZ { dimensions: UVec3::new(X, Y, Z), .. }",
       "ClusterConfig: leave it alone; its default makes these X x Y x Z clusters of this viewport, and others of "
       "another",
       {"/tiles/count", "/slices/count"},
       {{"GlobalClusterSettings::view_cluster_bindings_max_indices", Needed::entries, 16384, 1, k_any}},
       "after a frame with more, tiles grow until lists fit (dynamic_resizing); that frame itself is whole with "
       "storage buffers, and lacks entries without"},
      {"bevy-gpu",
       "GlobalClusterGpuSettings",
       "ClusterConfig::XYZ { dimensions: UVec3::new(X, Y, Z), .. }",
       "ClusterConfig: leave it alone; its default makes these X x Y x Z clusters of this viewport, and others of "
       "another",
       {"/tiles/count", "/slices/count"},
       {{"GlobalClusterSettings::view_cluster_bindings_max_indices", Needed::entries, 16384, 1, k_any},
        {"GlobalClusterSettings::gpu_clustering.initial_index_list_capacity", Needed::entries, 0, 1, k_any}},
       "after a frame with more than max_indices, tiles grow in the next one (dynamic_resizing, on the GPU, too); "
       "where "
       "the list itself has no room it grows after a few frames that lack lights"},
      {"ogre-next",
       "SceneManager, as since 2.3",
       "setForwardClustered(true, X, Y, Z, lightsPerCell, decalsPerCell, cubemapProbesPerCell, minDistance, "
       "maxDistance)",
       "",
       {"/tiles/count"},
       {{"lightsPerCell", Needed::longest_list, 96, 1, k_any}},
       "a full cell takes no more lights"},
      {"unreal",
       "console variables",
       "r.Forward.LightGridPixelSize P, r.Forward.LightGridSizeZ Z",
       "",
       {"/tiles/pixels", "/slices/count"},
       {{"r.Forward.MaxCulledLightsPerCell", Needed::entries_per_cell, 32, 1, k_any}},
       "the pool has room for so many entries times the cells; where a frame needs more, lights are missing in some "
       "cells. From documentation: versions that cull by depths first need less than is counted here"},
      {"unity-urp",
       "package com.unity.render-pipelines.universal-config, as since URP 14",
       "",
       "",
       {},
       {{"MAX_VISIBLE_LIGHT_COUNT_DESKTOP (ShaderConfig.cs.hlsl) and k_MaxVisibleLightCountDesktop (ShaderConfig.cs)",
         Needed::lights_in_view, 256, 1, 256}},
       "lights beyond it are not drawn; on mobile platforms the limits are 32 and 16"},
  };
  return rows;
}

std::string version_text(const EngineRow& row) {
  const config::Preset& preset = *config::find_preset(row.preset);
  const std::string& engine = preset.engine;
  return engine.substr(0, engine.find(',')) + " (" + preset.version + "), " + row.settings;
}

std::string settable_grid_text(const EngineRow& row) {
  constexpr std::pair<const char*, const char*> k_flags[] = {{"/tiles/pixels", "--tiles N (pixels of a square tile)"},
                                                             {"/tiles/count", "--tiles XxYt (tiles across and down)"},
                                                             {"/slices/count", "--slices N"},
                                                             {"/cells", "--set 'grids.*.cells=[[X,Y,Z]]'"}};
  std::vector<std::string> flags;
  for (const std::string key : row.grid_keys)
    for (const auto& [pointer, flag] : k_flags)
      if (key == pointer) flags.emplace_back(flag);
  return joined(flags);
}

const EngineRow* row_of_engine(const std::string& name) {
  const auto found =
      std::ranges::find(engine_rows(), name, [](const EngineRow& row) { return std::string(row.preset); });
  return found == engine_rows().end() ? nullptr : &*found;
}

bool is_of_lists(Needed needed) {
  return needed == Needed::longest_list || needed == Needed::entries || needed == Needed::entries_per_cell;
}

std::string measure_of(Needed needed) {
  switch (needed) {
    case Needed::lights_in_view:
      return "lights";
    case Needed::lights_of_type:
      return "lights-of-type";
    case Needed::longest_list:
      return "longest";
    case Needed::entries:
    case Needed::entries_per_cell:
      return "entries";
    case Needed::lights_in_scene:
      break;
  }
  return "";
}

std::string why_nothing_is_set(const std::string& name) {
  const auto found = std::ranges::find(k_constants, name, [](const Constant& row) { return std::string(row.name); });
  return found == std::end(k_constants) ? "" : found->what;
}

SettingValue value_of(const LimitSetting& setting, const SizedStructure& structure, const AllocationRules& rules) {
  SettingValue out{&setting, most_seen(structure, setting.needed), most_found(structure, setting.needed)};
  auto with_margin = static_cast<std::uint64_t>(std::ceil(static_cast<double>(out.needed()) * rules.margin));
  if (setting.needed == Needed::lights_in_scene)
    with_margin = std::max(with_margin, most_lights(structure, setting.needed).value_or(0));
  if (const auto lights = most_lights(structure, setting.needed);
      lights && setting.needed != Needed::entries && with_margin >= *lights) {
    with_margin = *lights;
    out.is_all = true;
  }
  out.wanted = (std::max(with_margin, setting.least) + setting.multiple - 1) / setting.multiple * setting.multiple;
  out.value = std::min(out.wanted, setting.most);
  return out;
}

}  // namespace clusterbench::report
