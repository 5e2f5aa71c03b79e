#pragma once
// The result of a run. report/ turns it into JSON, a table and exports.

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "assign/contract/device_work.h"
#include "config/config.h"
#include "gpu/device/device_facts.h"
#include "gpu/methods/arithmetic_probe.h"
#include "gpu/reading/cost_fit.h"
#include "gpu/reading/walking.h"
#include "measure/lists/buffers.h"
#include "measure/lists/lights_beyond_grid.h"
#include "measure/lists/lights_in_view_counts.h"
#include "measure/lists/occupancy.h"
#include "measure/lists/stability.h"
#include "measure/samples/coherence.h"
#include "measure/samples/depth_ranges.h"
#include "measure/samples/lookup_check.h"
#include "measure/samples/packing_loss.h"
#include "measure/samples/shading.h"
#include "measure/shadows/shadow_cull.h"
#include "measure/shadows/shared_frusta.h"
#include "measure/statistics/time_statistics.h"
#include "measure/truth/list_errors.h"
#include "os/processor.h"
#include "plugin/plugins.h"
#include "result/broken_case.h"
#include "run/cases/plan.h"
#include "run/counters/instruction_counter.h"
#include "run/findings/fit_meter.h"
#include "run/findings/packed_details.h"
#include "run/findings/pre_cull_meter.h"
#include "run/findings/reaction_meter.h"
#include "run/timing/timing_samples.h"

namespace clusterbench::run {

struct ToolFacts {
  std::string version, git_sha, compiler, flags, build_type, simd_target;
  std::vector<std::pair<std::string, std::string>> libraries;
};
ToolFacts tool_facts();

struct LoadFacts {
  double begin = 0.0, end = 0.0;  // running or waiting programs, mean over a minute: before and after the run
};

struct MachineFacts {
  std::string cpu, os;
  int cores = 0;
  std::uint64_t ram_bytes = 0;
  std::string family, model, stepping;                        // os/processor.h
  std::vector<std::pair<std::string, std::uint64_t>> caches;  // "l1d", bytes
  // The clock while something was timed.
  std::optional<os::Clock> clock;
  std::optional<LoadFacts> load;
  // Start of the SHA-256 of its name; "" where nothing depends on the machine.
  std::string host;
};
MachineFacts machine_facts();

struct SceneResult {
  std::string name, sha256;
  int points = 0, spots = 0, directionals = 0, boxes = 0;
  int dark = 0;              // lights among the points and spots that light nothing (scene/digests.h)
  std::string light_digest;  // scene/digests.h
  int frames = 0;
  nlohmann::json rig;         // {lights, spots, range, size, seed} of a generated rig; else null
  nlohmann::json range_rule;  // {cutoff_lux, max_range, given, from_intensity, clamped}
  std::vector<std::string> warnings;
};

struct Versus {
  std::string assigner;
  measure::Ratio ratio;  // this case's frame time / that assigner's
};

// The slowest of the timed frames, which include the frame with most pairs.
struct WorstTimedFrame {
  int frame = 0;  // index in the path
  double ns = 0.0;
  measure::Interval ci95;
  std::optional<std::uint64_t> pairs;
};

// The same frames repeatedly, so that caches hold as much of them as fits.
struct WarmTimes {
  measure::TimeStats frame_ns, assign_ns;
  std::optional<measure::TimeStats> convert_ns, pre_cull_ns;
};

// Per frame, by the own clock of the device (a GPU) that a method runs on.
struct DeviceSpanTimes {
  measure::TimeStats run_ns, upload_ns, readback_ns;
  measure::TimeStats floor_ns;  // as many steps that do nothing but write as many bytes
  double floor_ratio = 0.0;
  assign::DeviceRepeats repeats;  // in the frame with fewest
};

struct DeviceTimes {
  std::string device;  // name and driver
  bool is_software = false;
  int frames_timed = 0, launches = 1;
  double dispatches = 0.0;              // per frame
  std::optional<DeviceSpanTimes> cold;  // if configured
  DeviceSpanTimes warm;
  std::optional<measure::TimeStats> build_ns;  // of methods whose device builds
  double builds_per_frame = 0.0;
  std::vector<double> clock_mhz;  // of the rounds in which the device told it
  std::vector<assign::ShaderStatistic> shaders;

  bool is_cold() const { return cold.has_value(); }
  const DeviceSpanTimes& first() const { return cold ? *cold : warm; }
};

// One way in which the waves of a device walk the lights of a set's samples. Times are of a frame, with warm caches
// where nothing else is said.
struct WalkReading {
  gpu::Walking walking = gpu::Walking::by_lane;
  measure::TimeStats read_ns, cold_ns;
  std::optional<measure::TimeStats> exact_ns;  // of the exact lists; without the truth of cells there are none
  std::optional<measure::Ratio> exact_ratio;   // read_ns / exact_ns
  measure::Ratio nothing_ratio;                // read_ns / nothing_ns
};

// What the samples of a set pay for their lights on a device.
struct SetReading {
  measure::SampleSet set = measure::SampleSet::opaque;
  gpu::ReadingWork work;                           // over the frames
  std::optional<std::uint64_t> exact_lights = {};  // that the samples walk in the exact lists
  std::uint64_t differing = 0;          // samples for which the device walked other lights than the structure has
  measure::TimeStats write_ns;          // a word for each sample
  measure::TimeStats nothing_ns;        // the lookup as well
  std::vector<WalkReading> walks = {};  // in the order of the configuration
};

struct ReadingResult {
  std::string device;  // name and driver
  bool is_software = false;
  int frames = 0;
  double structure_bytes = 0.0;  // mean
  // The figures are those of this set and walk; none where they are missing.
  measure::SampleSet set = measure::SampleSet::opaque;
  gpu::Walking walking = gpu::Walking::by_lane;
  struct ExactLists {
    std::string storage;
    double bytes = 0.0;  // mean
  };
  std::optional<ExactLists> exact = {};  // without the truth of cells there are none
  std::vector<SetReading> sets = {};     // in the order of the configuration, those that the scene has
};

// Times of slices that follow the needs of frames.
struct FitTimes {
  measure::TimeStats follow_ns;    // per frame: finding the needed span, and making the grid; not part of other times
  measure::TimeStats unfitted_ns;  // frame_ns of the same case in the grid that does not follow, in the same rounds
  measure::Ratio ratio;            // frame_ns / unfitted_ns
};

// One way to remove lights in shadow from a method's lists.
struct ShadowCullResult {
  config::ShadowCullRequest request;
  measure::ShadowCullCounts counts;
  bool has_truth = false, has_samples = false;  // which of the counts are valid
  struct Maps {
    std::uint64_t lights = 0;     // with a map
    std::uint64_t made = 0;       // over the path: more if lights or surfaces move
    std::uint64_t faces = 0;      // of the maps that were made
    std::uint64_t texels = 0;     // of these maps, those that the light reaches
    std::uint64_t unlimited = 0;  // of these, without a distance
    std::uint64_t bytes = 0;      // of all levels, of the maps that are cached at the same time
  } maps;
  // Wall time in this process; kept if the configuration requests times.
  struct Times {
    double cast_ns = 0.0, reduce_ns = 0.0;         // of a map, mean
    double step_mean_ns = 0.0, step_max_ns = 0.0;  // of a frame's lists, on one thread
  } times;
};

// Savings of shared shadow maps, which do not depend on method and grid.
struct SharedFrustaResult {
  config::SharedFrustaRequest request;
  measure::SharingCounts counts;
};

struct TimingResult {
  bool is_cold = false;                           // the times below are cold: caches were swept before each frame
  std::string session;                            // the same for cases that the same launches measured
  int launches = 1;                               // processes, each of which measured an equal share of the samples
  measure::TimeStats frame_ns;                    // per frame: pre-cull, assign and convert, of the same rounds
  measure::TimeStats build_ns, assign_ns;         // assign: per frame, with the builds that the frames need
  std::optional<measure::TimeStats> convert_ns;   // per frame; only if lists are converted
  std::optional<measure::TimeStats> pre_cull_ns;  // per frame; only if there is one
  std::optional<WarmTimes> warm;                  // beside cold times
  int warm_assign_passes = 1;                     // over the timed frames in a warm sample, in the launch with fewest
  std::optional<int> warm_convert_passes;
  double builds_per_frame = 0.0;  // 0 if the grid stays, 1 if each frame has its own
  WorstTimedFrame worst;
  std::optional<double> pairs_mean;  // of the timed frames; none without cells
  std::uint64_t pairs_max = 0;
  // frame time / pairs in lists; without pairs: not a number
  double ns_per_pair = std::numeric_limits<double>::quiet_NaN();
  double write_floor_ns = 0.0;                 // per frame
  double floor_ratio = 0.0;                    // of warm times
  std::optional<Versus> against_first;         // against the group's first assigner, with the same storage if it has it
  std::optional<FitTimes> fit;                 // of slices with `fit`
  std::vector<ShadowCullResult> shadow_culls;  // those of the case, for their times
  int frames_timed = 0;                        // in the means
  Disturbance disturbance;                     // of the group, over all launches
};

// Instructions of the work that TimingResult times.
struct CountResult {
  std::string source;       // "perf" or "callgrind"
  std::string simd_target;  // of the counted code: valgrind offers a program fewer instruction sets than the machine
  int frames = 0;           // counted, the same that are timed
  Counted build;            // of one build
  Counted assign;           // over all frames
  std::optional<Counted> convert;        // over all frames; only if lists are converted
  std::optional<Counted> pre_cull = {};  // over all frames; only if there is one
};

// One method's lists along a finely sampled piece of the path, beside the true lists along the same piece.
struct StabilityResult {
  measure::Churn method, truth;
  int window = 1;                       // steps within which a change back counts as a flicker
  double step_m = 0.0, step_deg = 0.0;  // largest move and turn of the camera in one step
  int from_frame = 0;                   // of the path
  bool is_drift = false;                // the camera stands still and was moved artificially
  std::string path;                     // one line: source of the steps
  int grids = 0;                        // made along the piece; with more than one, the cells themselves move
  std::uint64_t undecided = 0;          // pairs of the truth over all steps; counted as true
};

// The counts at a set of samples.
struct SampleSetResult {
  measure::SampleSet set = measure::SampleSet::opaque;
  measure::ShadingCounts counts;
  std::optional<measure::Coherence> coherence;  // of visible surfaces at full resolution
  std::optional<double> ground_m = {};  // height of the floor that replaces surfaces in a scene without triangles
};

// The packing of the lights and its errors.
struct PrecisionResult {
  std::string packing, label;  // "half"; "half+inflate"
  bool inflate = false;
  measure::PackingLoss loss;  // before inflation
};

// The cull of the lights before the method gets them.
struct PreCullResult {
  std::string label;  // "frustum+distance(100)"
  PreCullCounts counts;
};

// A reason for a run to fail.
struct Failure {
  enum class Kind : std::uint8_t { lost_pairs, extra_pairs, lost_at_samples, dropped_pairs, wrong_readings };
  Kind kind = Kind::lost_pairs;
  std::string text;  // without the case's name
};

// A fact that a reader must know, which does not fail the run.
struct Warning {
  enum class Kind : std::uint8_t {
    dropped_pairs,
    unlit,
    undecided,
    lost_pairs,
    unchecked,
    too_many_lights,
    repeated_lights
  };
  Kind kind = Kind::dropped_pairs;
  std::string text;  // without the case's name
};

// The path along which the camera is measured.
struct CameraPathFacts {
  double from_s = 0.0, to_s = 0.0;
  std::string digest;  // scene/digests.h; "" for a generated path
};

struct CaseResult {
  std::string id, settings, name, scene, camera;  // id and settings: see CasePlan
  CameraPathFacts camera_path;
  Vec2i viewport{0, 0};
  int frames = 0;
  nlohmann::json grid;  // {kind, cells, ... boundaries, lookup constants}
  std::string assigner, assigner_label;
  nlohmann::json assigner_params;
  // conservative: packed lights must be inflated for it, and a pre-cull must be conservative, too
  bool conservative = true, exact = false;
  std::string storage_label;
  std::string preset;                    // config/presets/preset_library.h; "" for the configuration's own clusterings
  int lights = 0;                        // lights of the scene that methods get: points, spots, and boxes if requested
  measure::LightsInView lights_in_view;  // the same for all cases of a camera and viewport
  std::optional<measure::LightsBeyondGrid> lights_beyond_grid;  // with the grid's cells
  std::optional<measure::Occupancy> occupancy;                  // with cells
  measure::Buffers buffers;
  std::uint64_t tests_done = 0;               // over all frames
  std::uint64_t fallbacks = 0;                // over all frames
  std::optional<measure::ErrorCounts> error;  // with cells, if requested
  // its grid's cells if they are too many to compare; 0: compared, or not requested
  std::uint64_t cells_not_compared = 0;
  std::string deepest_miss_light;                    // name in the rig
  std::optional<measure::ShadingCounts> shading;     // in the whole view
  std::vector<SampleSetResult> samples;              // of the other sets, if requested and the scene has them
  std::optional<measure::DepthRanges> depth_ranges;  // of visible surfaces in a frustum grid, if requested
  std::vector<measure::LookupCounts> lookup;         // one per lookup; empty if not requested
  std::optional<PrecisionResult> precision;          // if the configuration requests more than float32
  std::optional<PreCullResult> pre_cull;             // if there is one
  std::optional<StabilityResult> stability;          // with cells, if requested
  std::optional<FitResult> fit;                      // of slices with `fit`
  std::optional<ReactionResult> reaction;            // of tiles that react
  std::optional<FallbackResult> fallback;            // of a storage with limited room
  std::vector<ShadowCullResult> shadow_culls;        // of lists, one per way; empty if not requested
  std::optional<SharedFrustaResult> shared_frusta;   // if requested
  std::optional<TimingResult> timing;
  bool on_device = false;                  // the method runs on a device
  std::string origin_file, origin_sha256;  // of a method that is not built in
  std::optional<DeviceTimes> device;       // its times, in place of `timing`
  std::optional<ReadingResult> reading;    // if requested
  std::string unread;                      // why there is none though it was requested
  std::optional<CountResult> count;        // if requested
  std::optional<Details> details;          // with cells, if requested
  std::vector<Failure> failures;           // run/findings/gate.h
};

// Cells of the case's grid in a frame.
Vec3i cells_in(const CaseResult& result, int frame);

struct Result {
  std::string config_name;
  std::string date, command;  // "" without timing: the result is then the same whenever it is made
  ToolFacts tool;
  std::vector<const plugin::LoadedPlugin*> plugins;  // of the configuration's methods
  MachineFacts machine;
  std::optional<gpu::DeviceFacts> device;     // if a case runs on it
  std::optional<gpu::Arithmetic> arithmetic;  // of the device
  nlohmann::json config;
  std::vector<SceneResult> scenes;
  std::vector<CaseResult> cases;
  std::vector<Skipped> skipped;
  std::vector<result::BrokenCase> broken;  // that this process found
  std::vector<std::string> planned_ids;    // of all cases of the plan, in its order
  std::optional<PlannedShard> shard;       // the plan's
};

}  // namespace clusterbench::run
