#pragma once
// A checked configuration: every key has a value, paths are resolved.

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "assign/contract/assigner.h"
#include "config/config_flags.h"
#include "config/json_text.h"
#include "config/limit_rules.h"
#include "core/memory.h"
#include "cull/pre_cull_spec.h"
#include "depth/shadow_map.h"
#include "grid/grid.h"
#include "measure/lists/buffers.h"
#include "measure/samples/lookup_check.h"
#include "measure/samples/samples.h"
#include "scene/camera_path.h"
#include "scene/rig.h"
#include "scene/scene.h"
#include "view/packing.h"

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

// The format of the lights that assigners get. The truth always uses the scene's own lights.
struct PrecisionRequest {
  view::Packing packing = view::Packing::float32;
  bool inflate = false;  // grow each light by the largest error of its format

  bool is_lossy() const { return packing != view::Packing::float32; }
  std::string label() const;  // "float32", "half", "half+inflate"

  friend bool operator==(const PrecisionRequest&, const PrecisionRequest&) = default;
};

struct TimingRequest {
  bool measure = true;
  int rounds = 31;
  double min_time_ms = 20.0;  // of one round of one case
  int frames = 8;             // evenly spaced timed frames; 0 = all
  int launches = 5;           // processes that share the rounds, if the caller can start some
  bool cold = true;           // empties the caches before each frame; these times are the ones reported first
};

// Changes of lists along a finely sampled piece of the path.
struct StabilityRequest {
  int steps = 200;
  double step_mm = 1.0;    // largest move of the eye in a step
  double step_deg = 0.01;  // largest turn of the view in a step
  int window = 8;          // a pair that changes back within this many steps flickers
};

// Tests of a shader's lookup on samples.
struct LookupRequest {
  int samples = 4096;  // per frame
  std::vector<measure::LookupWay> ways;
};

// A horizontal floor, for scenes without triangles.
struct GroundRequest {
  bool is_lowest = false;  // below all lights and eyes of the scene
  double height_m = 0.0;   // along the world's y, unless is_lowest
};

// Points where frames are shaded. Members that the set does not use keep their defaults.
struct SampleSetRequest {
  measure::SampleSet set = measure::SampleSet::volume;
  int count = 1024;                       // volume, mirror, anywhere: per frame
  int divisor = 8;                        // opaque, transparent: one ray per block of so many pixels squared
  int layers = 4;                         // transparent: maximum per ray
  Vec3i froxels{160, 90, 64};             // fog
  std::optional<GroundRequest> ground{};  // opaque

  bool needs_bounds() const { return set == measure::SampleSet::mirror || set == measure::SampleSet::anywhere; }
  bool needs_triangles() const { return set == measure::SampleSet::opaque || set == measure::SampleSet::transparent; }
};

// A step after the lists: removes pairs whose cell is completely in the light's shadow.
struct ShadowCullRequest {
  depth::ShadowMapRequest map;
  double bias_m = 0.01;  // a point within this distance behind a surface still counts as lit

  friend bool operator==(const ShadowCullRequest&, const ShadowCullRequest&) = default;
};

// Which spots may share a shadow map.
struct SharedFrustaRequest {
  double apart_m = 2.0;
  double turned_deg = 15.0;
  double growth = 1.5;
};

// Frames that a result contains cell by cell.
struct DetailsRequest {
  // worst: the one with the case's longest list; evenly: `count` of them; listed: `frames`
  enum class Choice : std::uint8_t { worst, evenly, listed };
  Choice choice = Choice::worst;
  int count = 0;
  std::vector<int> frames;  // ascending, each once
  bool lists = true;        // with the lights of each cell
  std::size_t max_bytes = 2'000'000;
};

// Cases above all_pairs are skipped, with the reason. Cases above the memory limit are skipped if that is known in
// advance; otherwise the run ends with an error.
struct LimitsRequest {
  std::optional<std::uint64_t> all_pairs;  // lights x cells of methods that test every light against every cell
  std::uint64_t memory_mib = k_default_memory_limit >> 20;  // of one list, buffer or table: core/memory.h
  std::vector<LimitRule> fail_if;                           // budgets that fail the run
  std::filesystem::path baseline;                           // a result to compare with in relative budgets; "" without
  bool allows_no_lights = false;                            // budgets pass even if no light was measured
  bool allows_changed_lights = false;                       // the lights may differ from the baseline's
  // Pairs that a case's storage may drop over all frames before the run fails; none: no limit.
  std::optional<std::uint64_t> dropped_pairs = 0;
};

// A preset's clustering for one viewport, as indices in the configuration's lists. No storage: the assigner's own
// structure.
struct PresetChoice {
  std::string preset;  // config/presets.h
  std::size_t viewport = 0, grid = 0, assigner = 0;
  std::optional<std::size_t> storage;
  // One for each of the configuration's own_pre_culls: that pre-cull followed by the engine's own steps, such as its
  // limit of lights.
  std::vector<std::size_t> pre_culls = {};
};

struct Config {
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
  std::size_t own_pre_culls = 1;  // the others belong to presets
  int threads = 1;
  std::uint64_t seed = 1;
  bool check_accuracy = true;
  // Limit on the estimated pairs of a frame's grid up to which cases are compared with the truth; none: no limit.
  std::optional<std::uint64_t> most_pairs;
  std::vector<SampleSetRequest> sample_sets;         // each set once; the whole view's first
  std::optional<StabilityRequest> stability;         // none: not measured
  std::optional<LookupRequest> lookup;               // none: not measured
  std::optional<DetailsRequest> details;             // none: no details
  std::vector<ShadowCullRequest> shadow_culls;       // each once; empty: not measured
  std::optional<SharedFrustaRequest> shared_frusta;  // none: not measured
  TimingRequest timing;
  LimitsRequest limits;
  measure::AllocationRule allocation;

  // With other precisions than float32, results show the losses of each precision.
  bool compares_precisions() const { return precisions != std::vector<PrecisionRequest>{{}}; }

  nlohmann::json resolved;  // the configuration with all defaults, as in the result
  GridChange preset_grid;   // members that replace those of presets' grids
  JsonText text;            // as read, with positions for messages
};

// Applies a merge patch (RFC 7396) to the configuration's keys and reads it again, so that all fields follow from its
// keys. Throws Error.
Config changed(const Config& config, const nlohmann::json& patch);

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
