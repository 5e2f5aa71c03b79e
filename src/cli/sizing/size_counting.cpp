#include "cli/sizing/size_counting.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "assign/contract/assigner.h"
#include "cli/output/duration.h"
#include "cli/output/output.h"
#include "cli/output/progress_line.h"
#include "core/file_text.h"
#include "core/json_document.h"
#include "core/text.h"
#include "os/stop_signals.h"
#include "report/cases/columns.h"
#include "report/results/result_record.h"
#include "run/cases/path_frames.h"
#include "run/estimate.h"
#include "run/findings/reaction_meter.h"
#include "run/runner.h"

namespace clusterbench::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr double k_least_rate_hz = 30.0, k_most_rate_hz = 240.0;
constexpr int k_sampled_frames = 3, k_least_frames = 30;
// Limit of the work for counting by default, in units of frame_work_ns().
constexpr double k_most_work_ns = 60e9;

// A flag of the command line that chooses frames: --set scenes.*.frames=120.
bool requests_frames(const config::FlagValue& flag) {
  const std::string key = flag.value.substr(0, flag.value.find('='));
  return flag.name == "--set" && key.find("scenes") != std::string::npos && key.find("frames") != std::string::npos;
}

// For each scene of the configuration, whether it requests frames. Scenes on the command line do not.
std::vector<bool> scenes_with_frames(const RunInputs& inputs, std::size_t scenes) {
  const bool is_flagged = std::ranges::any_of(flag_values(inputs), requests_frames);
  std::vector<bool> has_frames(scenes, is_flagged);
  if (is_scene(inputs.paths.front()) || is_flagged) return has_frames;
  const Json file = json_or_discarded<Json>(file_text(inputs.paths.front()), JsonComments::allowed);
  const bool is_list = file.is_object() && file.contains("scenes") && file["scenes"].is_array();
  // Scenes expanded from axes do not match those of the file.
  if (!is_list || file["scenes"].size() != scenes) return std::vector<bool>(scenes, true);
  for (std::size_t i = 0; i < scenes; ++i)
    has_frames[i] = file["scenes"][i].is_object() && file["scenes"][i].contains("frames");
  return has_frames;
}

config::FlagValue setting(std::size_t scene, const std::string& key, const std::string& value) {
  return {"--set", "scenes." + std::to_string(scene) + "." + key + "=" + value};
}

// One allocation serves all cameras: a scene that names none uses all.
std::vector<config::FlagValue> all_cameras(const config::Config& given) {
  std::vector<config::FlagValue> flags;
  const nlohmann::json& scenes = given.resolved["scenes"];
  for (std::size_t i = 0; i < scenes.size(); ++i)
    if (scenes[i].is_object() && scenes[i].value("camera", "").empty()) flags.push_back(setting(i, "camera", "*"));
  return flags;
}

// Methods for scenes without a choice of methods: exact lists, one method for each kind of grid. Other methods have
// longer lists, which would not be printed.
constexpr const char* k_exact_methods = "exact-fast,distance-fast,cascades-fast,world-grid-fast";

bool uses_exact_methods(const RunInputs& inputs, const std::string& filter, bool all_methods) {
  const std::vector<config::FlagValue> flags = flag_values(inputs);
  const bool has_presets = std::ranges::any_of(flags, [](const auto& flag) { return flag.name == "--preset"; });
  const bool names_methods = has_presets || config::names_key(flags, "(assigners|storages|presets)") ||
                             std::ranges::any_of(flags, [](const auto& flag) { return flag.name == "--assigner"; });
  return is_scene(inputs.paths.front()) && filter.empty() && !all_methods && !names_methods;
}

// Removes the keys that only times or pictures need; lists are not compared with the truth.
config::Config counting_only(const config::Config& config) {
  config::Config out = config::changed(config::with_presets_on_processor(config), {{"timing", {{"measure", false}}},
                                                                                   {"accuracy", {{"check", false}}},
                                                                                   {"stability", nullptr},
                                                                                   {"lookup", nullptr},
                                                                                   {"details", nullptr},
                                                                                   {"shadow_cull", nullptr},
                                                                                   {"shadow_frusta", nullptr}});
  out.counts_scratch =
      std::ranges::find(out.limits.fail_if, "scratch_bytes", &config::LimitRule::figure) != out.limits.fail_if.end();
  return out;
}

// Whether a method lists all lights of each cell, whatever its parameters and its lights: its lists and those of other
// such methods then lack the same lights at samples, those outside of the grid.
bool lists_all_lights(const config::Config& config, const run::CasePlan& case_plan) {
  const config::MethodRequest& request = config.assigners[case_plan.assigner];
  const assign::AssignerDescriptor& assigner = *assign::find_assigner(request.name);
  return case_plan.storage && !assigner.at_surfaces &&
         (assigner.exact || assign::is_conservative(assigner, request.params)) &&
         config.pre_culls[case_plan.pre_cull].steps.empty() && !config.precisions[case_plan.precision].is_lossy();
}

// Samples show whether a structure loses lights, which decides only among several structures of one grid.
bool needs_samples(const config::Config& config, const run::Plan& plan) {
  using Structure = std::tuple<std::size_t, std::optional<std::size_t>, std::size_t, std::size_t, std::string>;
  std::map<std::pair<std::size_t, std::size_t>, std::set<Structure>> structures;  // by scene and grid
  bool may_lose = false;
  for (const run::GroupPlan& group : plan.groups)
    for (const run::CasePlan& one : group.cases) {
      structures[{group.scene, group.grid}].emplace(one.assigner, one.storage, one.precision, one.pre_cull, one.preset);
      may_lose = may_lose || !lists_all_lights(config, one);
    }
  return may_lose && std::ranges::any_of(structures, [](const auto& of_grid) { return of_grid.second.size() > 1; });
}

// The plan, with sets of samples only if sizes need them: rays for samples of surfaces can take most of the time.
run::Plan plan_of_counts(config::Config& config, const std::string& filter, run::SceneFiles& files) {
  std::vector<config::SampleSetRequest> samples = std::exchange(config.sample_sets, {});
  run::Plan plan = run::make_plan(config, filter, &files);
  if (samples.empty() || !needs_samples(config, plan)) return plan;
  config.sample_sets = std::move(samples);
  return run::make_plan(config, filter, &files);
}

// Paths with many frames use as many samples in total as 30 frames would.
void share_samples(config::Config& config, const run::Plan& plan) {
  constexpr int k_fewest = 32;
  std::size_t frames = 1;
  for (const run::SceneData& data : plan.scenes)
    for (const scene::CameraPath& path : data.paths) frames = std::max(frames, path.shots.size());
  const double share = std::min(1.0, static_cast<double>(k_least_frames) / static_cast<double>(frames));
  for (config::SampleSetRequest& set : config.sample_sets)
    set.count = std::min(set.count, std::max(k_fewest, static_cast<int>(share * set.count)));
}

run::Result counts_of(const config::Config& config, const run::Plan& plan, bool quiet,
                      std::span<const run::GroupCost> costs = {}) {
  ProgressLine progress(os::terminal(os::StandardStream::error), quiet);
  run::Listener listener;
  listener.on_progress = [&](const run::Progress& now) { progress.show(now); };
  return run::run_plan(config, plan, {}, listener, os::stop_on_signals(), {}, {}, costs);
}

// Approximate time to count a frame of a case on a core of 2020: a model based on counts, so that it is the same
// everywhere.
double frame_work_ns(const run::CaseResult& counted) {
  constexpr double k_ns_per_frame = 1.2e5, k_ns_per_cell = 9.0, k_ns_per_entry = 1.8, k_ns_per_test = 1.2;
  double cells = 1.0;
  for (const auto& axis : counted.grid["cells"]) cells *= axis.get<double>();
  const double frames = std::max(1, counted.frames);
  return k_ns_per_frame + k_ns_per_cell * cells +
         k_ns_per_entry * static_cast<double>(counted.buffers.index_entries.high_water) +
         k_ns_per_test * static_cast<double>(counted.tests_done) / frames;
}

// Sampling rate of a scene's paths, in frames per second: high enough for each of their keys.
double rate_of(const scene::Scene& scene, const scene::PathRequest& request) {
  scene::PathRequest keys = request;
  keys.choice = scene::FrameChoice::keys;
  double rate = k_least_rate_hz;
  for (const scene::Camera& camera : scene.cameras) {
    const std::vector<double> times = scene::camera_moments(scene, camera, keys).times_s;
    if (times.size() < 2) continue;
    rate = std::max(rate, static_cast<double>(times.size() - 1) / (times.back() - times.front()));
  }
  return std::min(k_most_rate_hz, std::ceil(rate - 1e-6));
}

double frames_at(double rate_hz, const scene::CameraPath& path) {
  return path.shots.size() < 2 ? 1.0
                               : std::floor((path.shots.back().time_s - path.shots.front().time_s) * rate_hz) + 1.0;
}

// The work for all frames of a scene at a rate, from the work for a few of them.
double work_at(double rate_hz, const run::SceneData& data, const run::Result& few) {
  double work = 0.0;
  for (const run::CaseResult& counted : few.cases) {
    const auto path = std::ranges::find(data.paths, counted.camera, &scene::CameraPath::camera);
    if (counted.scene != data.scene.name || path == data.paths.end()) continue;
    const double frames = path->made ? static_cast<double>(path->shots.size()) : frames_at(rate_hz, *path);
    work += frames * frame_work_ns(counted);
  }
  return work;
}

struct Sampling {
  std::vector<config::FlagValue> flags;
  bool is_coarser = false;  // than a path's keys, or than 30 frames a second
};

// Rates for the scenes that request none.
Sampling sampling_of(const RunInputs& inputs, std::vector<config::FlagValue> flags, const std::vector<bool>& has_frames,
                     const std::string& filter, run::SceneFiles& files) {
  Sampling out;
  std::vector<config::FlagValue> sampled_flags = flags;
  for (std::size_t i = 0; i < has_frames.size(); ++i)
    if (!has_frames[i]) sampled_flags.push_back(setting(i, "frames", std::to_string(k_sampled_frames)));
  config::Config config = counting_only(read_inputs(inputs, sampled_flags));
  config.sample_sets.clear();
  const run::Plan plan = run::make_plan(config, filter, &files);
  const run::Result few = counts_of(config, plan, true);
  out.flags = std::move(flags);
  double all = 0.0;
  for (std::size_t i = 0; i < has_frames.size(); ++i)
    if (!has_frames[i]) all += work_at(rate_of(plan.scenes[i].scene, config.scenes[i].camera), plan.scenes[i], few);
  const double share = std::min(1.0, k_most_work_ns / std::max(1.0, all));
  out.is_coarser = share < 1.0;
  for (std::size_t i = 0; i < has_frames.size(); ++i) {
    if (has_frames[i]) continue;
    double rate = rate_of(plan.scenes[i].scene, config.scenes[i].camera) * share;
    for (const scene::CameraPath& path : plan.scenes[i].paths)
      if (frames_at(1e9, path) > k_least_frames)
        rate = std::max(rate, (k_least_frames - 1) / (path.shots.back().time_s - path.shots.front().time_s));
    out.flags.push_back(setting(i, "frames", R"({"rate":)" + report::text("%.6g", rate) + "}"));
  }
  return out;
}

bool grows_for_lists(const grid::GridSpec& spec) {
  return spec.reaction && spec.reaction->to == grid::Reaction::To::entries;
}

// Without limits on the number of lights, and with tiles that do not grow where lists have no room. What a storage
// drops changes no buffer's need, and tiles that follow the lights in view (mask-words) are the engine's grid itself.
config::Config without_engine_limits(config::Config config) {
  for (cull::PreCullSpec& spec : config.pre_culls)
    std::erase_if(spec.steps, [](const cull::Step& step) { return std::holds_alternative<cull::MostStep>(step); });
  for (grid::GridSpec& spec : config.grids)
    if (grows_for_lists(spec)) spec = spec.unreacting();
  return config;
}

// Of each case of the plan whose tiles grow in `limited`, the configuration as it was: what they come to.
std::vector<report::GrownTiles> grown_tiles(const config::Config& limited, const run::Plan& plan) {
  std::vector<report::GrownTiles> out;
  for (const run::GroupPlan& group : plan.groups) {
    const grid::GridSpec& spec = limited.grids[group.grid];
    if (!grows_for_lists(spec)) continue;
    const run::TileMoves moves = run::tile_moves(spec, run::path_of(limited, plan, group));
    for (const run::CasePlan& case_plan : group.cases)
      out.push_back({case_plan.name,
                     spec.reaction->most,
                     static_cast<std::uint64_t>(moves.frames),
                     static_cast<std::uint64_t>(moves.reacted),
                     static_cast<std::uint64_t>(moves.over),
                     static_cast<std::uint64_t>(moves.amount.greatest),
                     {moves.requested.x, moves.requested.y},
                     {moves.fewest.x, moves.fewest.y}});
  }
  return out;
}

}  // namespace

std::optional<SizePlan> plan_for_size(const RunInputs& inputs, const std::string& filter, bool all_methods,
                                      const std::string& engine) {
  const config::Config given = read_inputs(inputs);
  std::vector<config::FlagValue> flags = all_cameras(given);
  const bool exact_methods = uses_exact_methods(inputs, filter, all_methods);
  if (exact_methods) flags.push_back({"--assigner", k_exact_methods});
  const std::vector<bool> has_frames = scenes_with_frames(inputs, given.scenes.size());
  const std::atomic<bool>& stop = os::stop_on_signals();
  const bool samples = std::ranges::find(has_frames, false) != has_frames.end();
  Sampling sampling{std::move(flags), false};
  run::SceneFiles files;
  if (samples) sampling = sampling_of(inputs, std::move(sampling.flags), has_frames, filter, files);
  if (stop) return {};
  SizePlan out{counting_only(read_inputs(inputs, sampling.flags)), {}, {}, {}, sampling.is_coarser, exact_methods};
  if (!engine.empty()) {
    out.limited = out.config;
    out.config = without_engine_limits(std::move(out.config));
  }
  out.plan = plan_of_counts(out.config, filter, files);
  if (out.limited) out.limited->sample_sets = out.config.sample_sets;
  if (samples) share_samples(out.config, out.plan);
  return out;
}

void print_planned_counting(SizePlan& plan, const std::string& then) {
  plan.costs = run::estimated_costs(plan.config, plan.plan);
  std::size_t frames = 0, paths = 0;
  for (const run::SceneData& data : plan.plan.scenes)
    for (const scene::CameraPath& path : data.paths) frames += path.shots.size(), ++paths;
  const std::string how = plan.plan.scenes.front().paths.front().how;
  std::string line = "counts " + number_of(frames, "frame") + " of " + number_of(paths, "camera path");
  if (!how.empty()) line += " (" + (paths > 1 ? "the first: " : std::string()) + how + ")";
  line = wait_text(line, run::sum_s(plan.costs),
                   {"--set 'scenes.*.frames=30'", "--grid KIND --tiles N --slices N", "--assigner NAME"});
  line += then + "; --set 'scenes.*.frames=N' takes N of each path";
  if (plan.is_coarser)
    line +=
        ". Fewer frames than the paths have, for want of time: --grid KIND --tiles N --slices N, one structure, has "
        "more";
  print_message(line);
  if (plan.has_exact_methods)
    print_message("of exact lists, the shortest that there are; --assigner NAME counts those of your method");
}

std::optional<SizeCounts> counted_for_size(SizePlan plan, bool quiet) {
  const run::Result result = counts_of(plan.config, plan.plan, quiet, plan.costs);
  if (os::stop_on_signals()) return {};
  for (const run::SceneResult& scene : result.scenes)
    for (const std::string& warning : scene.warnings) print_message("warning: " + scene.name + ": " + warning);
  if (result.cases.empty())
    for (const run::Skipped& skipped : result.skipped) print_message("skipped " + skipped.name + ": " + skipped.reason);
  else
    print_ended_cases(plan.plan, result);
  SizeCounts out{std::move(plan.config), std::move(plan.plan), report::record_of(result, {}), {}};
  out.result.conclusions.emplace();  // nothing was compared, so there is no recommendation
  if (plan.limited) out.grown = grown_tiles(*plan.limited, out.plan);
  return out;
}

}  // namespace clusterbench::cli
