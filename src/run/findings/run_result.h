#pragma once
// What a run found. report/ turns it into JSON, a table and exports.

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "config/config.h"
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
#include "run/cases/sweep.h"
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
  double begin = 0.0, end = 0.0;  // programs that run or wait to, mean of a minute: before and after the run
};

struct MachineFacts {
  std::string cpu, os;
  int cores = 0;
  std::uint64_t ram_bytes = 0;
  std::string family, model, stepping;                        // os/processor.h
  std::vector<std::pair<std::string, std::uint64_t>> caches;  // "l1d", bytes
  // How it was when something was timed.
  std::optional<os::Clock> clock;
  std::optional<LoadFacts> load;
};
MachineFacts machine_facts();

struct SceneResult {
  std::string name, sha256;
  int points = 0, spots = 0, directionals = 0, boxes = 0;
  int dark = 0;              // of the points and spots those that light nothing (scene/digests.h)
  std::string light_digest;  // scene/digests.h
  int frames = 0;
  nlohmann::json rig;         // {lights, spots, range, size, seed} of one that was made; else null
  nlohmann::json range_rule;  // {cutoff_lux, max_range, given, from_intensity, clamped}
  std::vector<std::string> warnings;
};

struct Versus {
  std::string assigner;
  measure::Ratio ratio;  // this case's frame time / that assigner's
};

// The slowest of the frames that are timed, the one with most pairs among them.
struct WorstTimedFrame {
  int frame = 0;  // of the path
  double ns = 0.0;
  measure::Interval ci95;
  std::optional<std::uint64_t> pairs;
};

// The same frames again and again, so that caches hold what of them fits.
struct WarmTimes {
  measure::TimeStats frame_ns, assign_ns;
  std::optional<measure::TimeStats> convert_ns, pre_cull_ns;
};

// Per frame, by the own clock of the device (a GPU) that a method runs on.
struct DeviceTimes {
  measure::TimeStats upload_ns, run_ns, readback_ns;
};

// Of slices that follow what frames need.
struct FitTimes {
  measure::TimeStats follow_ns;    // per frame: finding what is needed, and making the grid; in no other time
  measure::TimeStats unfitted_ns;  // frame_ns of the same case in the grid that does not follow, of the same rounds
  measure::Ratio ratio;            // frame_ns / unfitted_ns
};

// Of one way to take out of a method's lists what lies in shadow.
struct ShadowCullResult {
  config::ShadowCullRequest request;
  measure::ShadowCullCounts counts;
  bool has_truth = false, has_samples = false;  // what of the counts was counted
  struct Maps {
    std::uint64_t lights = 0;     // with a map
    std::uint64_t made = 0;       // over the path: more where lights or surfaces move
    std::uint64_t faces = 0;      // of those that were made
    std::uint64_t texels = 0;     // likewise, into which light goes
    std::uint64_t unlimited = 0;  // of these, without a distance
    std::uint64_t bytes = 0;      // of all levels, of the maps that are kept at once
  } maps;
  // Wall time in this process; kept where the configuration asks for times.
  struct Times {
    double cast_ns = 0.0, reduce_ns = 0.0;         // of a map, mean
    double step_mean_ns = 0.0, step_max_ns = 0.0;  // of a frame's lists, on one thread
  } times;
};

// What sharing shadow maps saves, whatever the method and grid are.
struct SharedFrustaResult {
  config::SharedFrustaRequest request;
  measure::SharingCounts counts;
};

struct TimingResult {
  bool is_cold = false;                           // the times that follow: caches were swept before each frame
  std::string session;                            // the same where the same launches have measured
  int launches = 1;                               // processes, each of which measured an equal share of the samples
  measure::TimeStats frame_ns;                    // per frame: pre-cull, assign and convert, of the same rounds
  measure::TimeStats build_ns, assign_ns;         // assign: per frame, with the builds that the frames need
  std::optional<measure::TimeStats> convert_ns;   // per frame; only where lists are converted
  std::optional<measure::TimeStats> pre_cull_ns;  // per frame; only where there is one
  std::optional<WarmTimes> warm;                  // beside cold times
  int warm_assign_passes = 1;                     // over the timed frames in a warm sample, in the launch with fewest
  std::optional<int> warm_convert_passes;
  std::optional<DeviceTimes> device;  // within warm times
  double builds_per_frame = 0.0;      // 0 where the grid stays, 1 where each frame has its own
  WorstTimedFrame worst;
  std::optional<double> pairs_mean;  // of the frames that are timed; none without cells
  std::uint64_t pairs_max = 0;
  double ns_per_pair = std::numeric_limits<double>::quiet_NaN();  // frame time / pairs in lists; without: not a number
  double write_floor_ns = 0.0;                                    // per frame
  double floor_ratio = 0.0;                                       // of warm times
  std::optional<Versus> against_first;         // against the group's first assigner, in the same storage if it has it
  std::optional<FitTimes> fit;                 // of slices with `fit`
  std::vector<ShadowCullResult> shadow_culls;  // those of the case, for their times
  int frames_timed = 0;                        // in the means
  Disturbance disturbance;                     // of the group, over all launches
};

// Instructions of what TimingResult times.
struct CountResult {
  std::string source;       // "perf" or "callgrind"
  std::string simd_target;  // of the counted code: valgrind shows a program fewer instruction sets than the machine has
  int frames = 0;           // counted, the same that are timed
  Counted build;            // of one build
  Counted assign;           // over all frames
  std::optional<Counted> convert;        // over all frames; only where lists are converted
  std::optional<Counted> pre_cull = {};  // over all frames; only where there is one
};

// One method's lists along a finely sampled piece of the path, beside the true lists along the same piece.
struct StabilityResult {
  measure::Churn method, truth;
  int window = 1;                       // steps within which a change back is a flicker
  double step_m = 0.0, step_deg = 0.0;  // largest move and turn of the camera in one step
  int from_frame = 0;                   // of the path
  bool is_drift = false;                // the camera stands still and was moved artificially
  std::string path;                     // one line: where the steps come from
  int grids = 0;                        // made along the piece; with more than one, cells themselves move
  std::uint64_t undecided = 0;          // pairs of the truth over all steps; counted as true
};

// What a set of samples finds.
struct SampleSetResult {
  measure::SampleSet set = measure::SampleSet::opaque;
  measure::ShadingCounts counts;
  std::optional<measure::Coherence> coherence;  // of visible surfaces at full resolution
  std::optional<double> ground_m = {};          // height of the floor that stands for surfaces, where there are none
};

// How the lights were handed over, and what that loses.
struct PrecisionResult {
  std::string packing, label;  // "half"; "half+inflate"
  bool inflate = false;
  measure::PackingLoss loss;  // before inflation
};

// What was done to lights before the method got them.
struct PreCullResult {
  std::string label;  // "frustum+distance(100)"
  PreCullCounts counts;
};

// What a run fails for.
struct Failure {
  enum class Kind : std::uint8_t { lost_pairs, extra_pairs, lost_at_samples, dropped_pairs };
  Kind kind = Kind::lost_pairs;
  std::string text;  // without the case's name
};

// What a run does not fail for, and a reader has to know.
struct Warning {
  enum class Kind : std::uint8_t { dropped_pairs, unlit, undecided, lost_pairs, unchecked, too_many_lights };
  Kind kind = Kind::dropped_pairs;
  std::string text;  // without the case's name
};

// Along which the camera is measured.
struct CameraPathFacts {
  double from_s = 0.0, to_s = 0.0;
  std::string digest;  // scene/digests.h; "" of a path that was made
};

struct CaseResult {
  std::string id, settings, name, scene, camera;  // the first two: of CasePlan
  CameraPathFacts camera_path;
  Vec2i viewport{0, 0};
  int frames = 0;
  nlohmann::json grid;  // {kind, cells, ... boundaries, lookup constants}
  std::string assigner, assigner_label;
  nlohmann::json assigner_params;
  bool conservative = true, exact = false;  // conservative: on lights that are packed, only if they are inflated;
                                            // behind a pre-cull, only if that is
  std::string storage_label;
  std::string preset;                    // config/presets.h; "" for the configuration's own clusterings
  int lights = 0;                        // of the scene that methods get: points, spots, and boxes where asked for
  measure::LightsInView lights_in_view;  // the same for all cases of a camera and viewport
  std::optional<measure::LightsBeyondGrid> lights_beyond_grid;  // with the grid's cells
  std::optional<measure::Occupancy> occupancy;                  // with cells
  measure::Buffers buffers;
  std::uint64_t tests_done = 0;                      // over all frames
  std::uint64_t fallbacks = 0;                       // over all frames
  std::optional<measure::ErrorCounts> error;         // with cells, where asked for
  std::uint64_t cells_not_compared = 0;              // of its grid, too many to be; 0: they were, or were not asked for
  std::string deepest_miss_light;                    // name in the rig
  std::optional<measure::ShadingCounts> shading;     // in the whole view
  std::vector<SampleSetResult> samples;              // of the other sets, where asked for and the scene has them
  std::optional<measure::DepthRanges> depth_ranges;  // of visible surfaces in a frustum grid, where asked for
  std::vector<measure::LookupCounts> lookup;         // one per way; empty where not asked for
  std::optional<PrecisionResult> precision;          // where the configuration asks for more than float32
  std::optional<PreCullResult> pre_cull;             // where there is one
  std::optional<StabilityResult> stability;          // with cells, where asked for
  std::optional<FitResult> fit;                      // of slices with `fit`
  std::optional<ReactionResult> reaction;            // of tiles that react
  std::optional<FallbackResult> fallback;            // of a storage whose room can end
  std::vector<ShadowCullResult> shadow_culls;        // of lists, one per way; empty where not asked for
  std::optional<SharedFrustaResult> shared_frusta;   // where asked for
  std::optional<TimingResult> timing;
  std::optional<CountResult> count;  // where asked for
  std::optional<Details> details;    // with cells, where asked for
  std::vector<Failure> failures;     // run/findings/gate.h
};

// Cells of the case's grid in a frame.
Vec3i cells_in(const CaseResult& result, int frame);

struct Result {
  std::string config_name;
  std::string date, command;  // "" where nothing is timed, and the result is the same whenever it is made
  ToolFacts tool;
  MachineFacts machine;
  nlohmann::json config;
  std::vector<SceneResult> scenes;
  std::vector<CaseResult> cases;
  std::vector<Skipped> skipped;
  std::vector<std::string> planned_ids;  // of all cases of the plan, in its order
};

}  // namespace clusterbench::run
