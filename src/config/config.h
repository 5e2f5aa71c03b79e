#pragma once
// A configuration after checking: every key has a value, paths are resolved.

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
  std::string named_by, named_at;     // the configuration that names it, and where in it; "" for scenes given otherwise
  std::optional<scene::RigSpec> rig;  // made in memory, in place of a file
  scene::GltfChoice choice;           // which of the file's scenes and animations
  scene::PathRequest camera;
  scene::RangeRule range_rule;
  bool boxes = false;  // the scene's oriented boxes are assigned, too
};

// A named method with its resolved parameters: an assigner or a storage.
struct MethodRequest {
  std::string name;
  assign::Params params;
  std::string label()
      const;  // "sphere-refinement(spot=narrowing)": the name and the parameters that differ from the default
};

// How lights are handed to the assigners. The truth is that of the scene whatever this is.
struct PrecisionRequest {
  view::Packing packing = view::Packing::float32;
  bool inflate = false;  // grow each light by what packing can have lost

  bool is_lossy() const { return packing != view::Packing::float32; }
  std::string label() const;  // "float32", "half", "half+inflate"

  friend bool operator==(const PrecisionRequest&, const PrecisionRequest&) = default;
};

struct TimingRequest {
  bool measure = true;
  int rounds = 31;
  double min_time_ms = 20.0;  // of one round of one case
  int frames = 8;             // evenly spaced frames that are timed; 0 = all
  int launches = 5;           // processes that share the rounds, where the caller can start some
  bool cold = true;           // caches are swept before each frame of the times that are told first
};

// How lists change along a finely sampled piece of the path.
struct StabilityRequest {
  int steps = 200;
  double step_mm = 1.0;    // largest move of the eye in a step
  double step_deg = 0.01;  // largest turn of the view in a step
  int window = 8;          // a pair that changes back within so many steps flickers
};

// How a shader's lookup is tried on samples.
struct LookupRequest {
  int samples = 4096;  // per frame
  std::vector<measure::LookupWay> ways;
};

// Points where frames are shaded. What the set has no use for keeps its default.
// A horizontal floor, for scenes without triangles.
struct GroundRequest {
  bool is_lowest = false;  // below all lights and eyes of the scene
  double height_m = 0.0;   // along the world's y, else
};

struct SampleSetRequest {
  measure::SampleSet set = measure::SampleSet::volume;
  int count = 1024;                       // volume, mirror, anywhere: per frame
  int divisor = 8;                        // opaque, transparent: one ray per block of so many pixels squared
  int layers = 4;                         // transparent: most per ray
  Vec3i froxels{160, 90, 64};             // fog
  std::optional<GroundRequest> ground{};  // opaque

  bool needs_bounds() const { return set == measure::SampleSet::mirror || set == measure::SampleSet::anywhere; }
  bool needs_triangles() const { return set == measure::SampleSet::opaque || set == measure::SampleSet::transparent; }
};

// A step after the lists: pairs are taken out whose cell lies wholly in the light's shadow.
struct ShadowCullRequest {
  depth::ShadowMapRequest map;
  double bias_m = 0.01;  // so far beyond a surface a point may lie and still be lit

  friend bool operator==(const ShadowCullRequest&, const ShadowCullRequest&) = default;
};

// Which spots may share a shadow map.
struct SharedFrustaRequest {
  double apart_m = 2.0;
  double turned_deg = 15.0;
  double growth = 1.5;
};

// Which frames a result carries cell by cell.
struct DetailsRequest {
  enum class Choice : std::uint8_t { worst, evenly, listed };  // the one with the case's longest list; count; frames
  Choice choice = Choice::worst;
  int count = 0;
  std::vector<int> frames;  // ascending, each once
  bool lists = true;        // each cell's lights, too
  std::size_t max_bytes = 2'000'000;
};

// Beyond all_pairs cases are skipped, with the reason; beyond the memory they are, too, where it is known before, or
// the run ends with an error.
struct LimitsRequest {
  std::optional<std::uint64_t> all_pairs;  // lights x cells of methods that test every light against every cell
  std::uint64_t memory_mib = k_default_memory_limit >> 20;  // of one list, buffer or table: core/memory.h
  std::vector<LimitRule> fail_if;                           // what fails the run
  std::filesystem::path baseline;                           // a result that relative budgets are held against; ""
  bool allows_no_lights = false;                            // budgets hold where there is nothing to measure
  bool allows_changed_lights = false;                       // than the baseline has
  // What a case's storage may drop over all frames before it fails the run; without: all that it likes.
  std::optional<std::uint64_t> dropped_pairs = 0;
};

// A preset's one clustering for a viewport, by indices in the configuration's lists. Without storage: the assigner's
// own structure.
struct PresetChoice {
  std::string preset;  // config/presets.h
  std::size_t viewport = 0, grid = 0, assigner = 0;
  std::optional<std::size_t> storage;
  // Beside the first own_pre_culls of the configuration: each of them and then what the engine does itself, such as its
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
  // The first so many of each list make a product; the others are presets'.
  static constexpr std::size_t k_all = std::numeric_limits<std::size_t>::max();
  std::size_t own_grids = k_all, own_assigners = k_all, own_storages = k_all;
  std::vector<PresetChoice> presets;  // by viewport, then in the order in which they were named
  std::vector<PrecisionRequest> precisions;
  std::vector<cull::PreCullSpec> pre_culls{{}};
  std::size_t own_pre_culls = 1;  // the others are presets'
  int threads = 1;
  std::uint64_t seed = 1;
  bool check_accuracy = true;
  std::optional<std::uint64_t> most_pairs;  // of a frame's grid, about, that are compared with the truth; without: all
  std::vector<SampleSetRequest> sample_sets;         // each set once; the whole view's first
  std::optional<StabilityRequest> stability;         // without: not measured
  std::optional<LookupRequest> lookup;               // without: not measured
  std::optional<DetailsRequest> details;             // without: none
  std::vector<ShadowCullRequest> shadow_culls;       // each once; none: not measured
  std::optional<SharedFrustaRequest> shared_frusta;  // without: not measured
  TimingRequest timing;
  LimitsRequest limits;
  measure::AllocationRule allocation;

  // More than float32, and so results tell what each precision loses.
  bool compares_precisions() const { return precisions != std::vector<PrecisionRequest>{{}}; }

  nlohmann::json resolved;  // the configuration with all defaults, as the result carries it
  GridChange preset_grid;   // members in place of those of the presets' grids
  JsonText text;            // as it was read: where each value stands, for messages
};

// The configuration with a merge patch (RFC 7396) of its keys: read again, so that it is what its keys say. Throws Error.
Config changed(const Config& config, const nlohmann::json& patch);

// Reads and checks a configuration file, and then what the command line's flags make of it. `defaults`: members of a
// configuration that stand for the schema's defaults where the file has none. `preset_grid`: of the grid of each preset
// these members in place of its own. Throws Error with "line:column /json/pointer" as its location, or with the flag.
Config load_config(const std::filesystem::path& path, std::span<const FlagValue> flags = {},
                   const nlohmann::json& defaults = {}, const GridChange& preset_grid = {});
// The same from text; `file` is for messages and for relative paths.
Config parse_config(const std::string& text, const std::filesystem::path& file, std::span<const FlagValue> flags = {},
                    const nlohmann::json& defaults = {}, const GridChange& preset_grid = {});
// The sweep that `run level.glb` does: sensible defaults.
Config default_config(const std::vector<std::filesystem::path>& scenes, std::span<const FlagValue> flags = {},
                      const nlohmann::json& defaults = {}, const GridChange& preset_grid = {});

}  // namespace clusterbench::config
