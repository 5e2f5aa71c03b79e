#pragma once
// A checked configuration: every key has a value, paths are resolved.

#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "assign/contract/assigner.h"
#include "config/config_flags.h"
#include "config/config_sections.h"
#include "config/schema/json_text.h"
#include "cull/pre_cull_spec.h"
#include "grid/grid.h"
#include "scene/camera_path.h"
#include "scene/rig.h"
#include "scene/scene.h"

namespace clusterbench::config {

struct SceneRequest {
  std::filesystem::path path;         // "" with a rig
  std::string named_by, named_at;     // the configuration that names it, and the position in it; "" for other scenes
  std::optional<scene::RigSpec> rig;  // made in memory, instead of a file
  scene::GltfChoice choice;           // the selected scene and animation of the file
  scene::PathRequest camera;
  scene::RangeRule range_rule;
  bool boxes = false;  // the scene's oriented boxes are also assigned
};

// A method, an assigner or a storage, with its resolved parameters.
struct MethodRequest {
  std::string name;
  assign::Params params;
  std::string label()
      const;  // "sphere-refinement(spot=narrowing)": the name and the parameters that differ from the default
};

// A preset's clustering for one viewport, as indices in the configuration's lists. No storage: the assigner's own
// structure.
struct PresetChoice {
  std::string preset;  // config/presets/preset_library.h
  std::size_t viewport = 0, grid = 0, assigner = 0;
  std::optional<std::size_t> storage;
  // One for each of the configuration's own_pre_culls: that pre-cull followed by the engine's own steps, such as its
  // limit of lights.
  std::vector<std::size_t> pre_culls = {};
};

struct Config : Sections {
  std::string name;
  std::filesystem::path file;  // "" = made from scenes on the command line
  std::vector<SceneRequest> scenes;
  std::vector<Vec2i> viewports;
  std::vector<grid::GridSpec> grids;
  std::vector<MethodRequest> assigners;
  std::vector<MethodRequest> storages;
  // The first own_* entries of each list make a product; the others belong to presets.
  static constexpr std::size_t k_all = std::numeric_limits<std::size_t>::max();
  std::size_t own_grids = k_all, own_assigners = k_all, own_storages = k_all;
  std::vector<PresetChoice> presets;  // by viewport, then in the order of their names in the configuration
  std::vector<PrecisionRequest> precisions;
  std::vector<cull::PreCullSpec> pre_culls{{}};
  std::size_t own_pre_culls = 1;                // the others belong to presets
  std::vector<SampleSetRequest> sample_sets;    // each set once; the whole view's first
  std::vector<SampleSetRequest> reading_sets;   // at which a device reads; empty: nothing is read
  std::vector<ShadowCullRequest> shadow_culls;  // each once; empty: not measured
  int threads = 1;                              // that count: threads_asked, or as many as there are processors
  bool counts_scratch = true;                   // false: nobody reads scratch_bytes (size)

  // With other precisions than float32, results show the losses of each precision.
  bool compares_precisions() const { return precisions != std::vector<PrecisionRequest>{{}}; }

  nlohmann::json resolved;  // the configuration with all defaults, as in the result
  GridChange preset_grid;   // members that replace those of presets' grids
  JsonText text;            // positions for messages, without the value
};

// Applies a merge patch (RFC 7396) to the configuration's keys and reads it again, so that all fields follow from its
// keys. Throws Error.
Config changed(const Config& config, const nlohmann::json& patch);
// With presets as they are where no device is named, for what counts and times nothing: a method on a device has what
// is left of lists that are full. Throws Error if the configuration's own methods run on the device.
Config with_presets_on_processor(const Config& config);

// Reads and checks a configuration file, and applies the command line's flags. `defaults`: members of a configuration
// that replace the schema's defaults for keys that the file does not have. `preset_grid`: members that replace those of
// each preset's grid. Throws Error with "line:column /json/pointer" or the flag as its location.
Config load_config(const std::filesystem::path& path, std::span<const FlagValue> flags = {},
                   const nlohmann::json& defaults = {}, const GridChange& preset_grid = {});
// The same from text; `file` is for messages and for relative paths.
Config parse_config(const std::string& text, const std::filesystem::path& file, std::span<const FlagValue> flags = {},
                    const nlohmann::json& defaults = {}, const GridChange& preset_grid = {});
// The configuration of `run level.glb`, with sensible defaults.
Config default_config(const std::vector<std::filesystem::path>& scenes, std::span<const FlagValue> flags = {},
                      const nlohmann::json& defaults = {}, const GridChange& preset_grid = {});

}  // namespace clusterbench::config
