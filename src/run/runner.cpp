#include "run/runner.h"

#include <algorithm>
#include <set>

#include "core/error.h"
#include "core/text.h"
#include "run/gate.h"
#include "run/grid_facts.h"
#include "run/passes/accuracy_pass.h"
#include "run/passes/details_pass.h"
#include "run/passes/stability_pass.h"
#include "run/passes/timing_pass.h"
#include "run/path_frames.h"
#include "run/scene_facts.h"

namespace clusterbench::run {
namespace {

nlohmann::json params_json(const assign::Params& params) {
  nlohmann::json out = nlohmann::json::object();
  for (const auto& [name, value] : params.values())
    out[name] = std::visit([](const auto& held) { return nlohmann::json(held); }, value);
  return out;
}

// An estimate of work in nanoseconds, only for the time that is left: truth, samples and lists of some frames.
double list_cost(const config::Config& config, const GroupPlan& group, std::size_t lights, int frames, int samples) {
  constexpr double k_ns_per_light = 2000.0, k_ns_per_brute_pair = 3.0, k_cells = 8000.0, k_ns_per_sample = 1000.0;
  double per_frame = static_cast<double>(lights) * k_ns_per_light + k_ns_per_sample * samples;
  for (const Method& method : methods_of(group))
    per_frame += assign::find_assigner(config.assigners[method.assigner].name)->all_pairs
                     ? static_cast<double>(lights) * k_cells * k_ns_per_brute_pair
                     : 1e5;
  return per_frame * frames;
}

double timing_cost(const config::Config& config, const GroupPlan& group) {
  if (!config.timing.measure) return 0.0;
  return 1.5e6 * config.timing.min_time_ms * config.timing.rounds * static_cast<double>(methods_of(group).size());
}

class Run {
 public:
  Run(const config::Config& config, const Plan& plan, const std::vector<std::string>& done, const Listener& listener,
      const std::atomic<bool>& stop, const Counts& counts)
      : config_(config),
        plan_(plan),
        done_(done.begin(), done.end()),
        listener_(listener),
        stop_(stop),
        counts_(counts) {
    for (const GroupPlan& group : plan.groups) {
      const GroupPlan left = what_is_left(group);
      progress_.cases_total += group.cases.size();
      progress_.cases_done += group.cases.size() - left.cases.size();
      if (left.cases.empty()) continue;
      progress_.cost_total +=
          accuracy_cost_of(left) + stability_cost_of(left) + details_cost_of(left) + timing_cost(config, left);
    }
  }

  Result result() {
    Result out;
    out.config_name = config_.name;
    out.tool = tool_facts();
    out.machine = machine_facts();
    if (config_.timing.measure) note_beginning(out);
    out.config = config_.resolved;
    out.skipped = plan_.skipped;
    for (std::size_t i = 0; i < plan_.scenes.size(); ++i) {
      out.scenes.push_back(scene_result(plan_.scenes[i], config_.scenes[i], config_.viewports));
      if (listener_.on_scene) listener_.on_scene(out.scenes.back());
    }
    for (const GroupPlan& group : plan_.groups)
      for (const CasePlan& one : group.cases) out.planned_ids.push_back(one.id);
    for (const GroupPlan& group : plan_.groups)
      if (!stop_) run_group(what_is_left(group), out);
    if (out.machine.load) out.machine.load->end = load_now().value_or(out.machine.load->begin);
    return out;
  }

 private:
  // What times can depend on. Without times a result does not say when it was made, so that it is the same every time.
  static void note_beginning(Result& out) {
    out.date = date_now();
    out.machine.clock = clock_now();
    if (const std::optional<double> load = load_now()) out.machine.load = LoadFacts{*load, *load};
  }

  GroupPlan what_is_left(GroupPlan group) const {
    std::erase_if(group.cases, [&](const CasePlan& one) { return done_.contains(one.id); });
    return group;
  }

  const scene::CameraPath& path_of(const GroupPlan& group) const {
    return plan_.scenes[group.scene].paths[group.camera];
  }

  double accuracy_cost_of(const GroupPlan& group) const {
    return list_cost(config_, group, plan_.scenes[group.scene].scene.lights.size(),
                     static_cast<int>(path_of(group).shots.size()), config_.shading_samples);
  }

  double stability_cost_of(const GroupPlan& group) const {
    if (!config_.stability) return 0.0;
    return list_cost(config_, group, plan_.scenes[group.scene].scene.lights.size(), config_.stability->steps, 0);
  }

  double details_cost_of(const GroupPlan& group) const {
    if (!config_.details) return 0.0;
    const config::DetailsRequest& request = *config_.details;
    const int frames = std::max({1, request.count, static_cast<int>(request.frames.size())});
    return list_cost(config_, group, plan_.scenes[group.scene].scene.lights.size(), frames, 0);
  }

  void tell(const GroupPlan& group, const char* stage, double cost) {
    progress_.cost_done += cost;
    const std::string& name = group.cases.front().name;
    progress_.doing = name.substr(0, name.find('/', name.find('/', name.find('/') + 1) + 1)) + ": " + stage;
    if (listener_.on_progress) listener_.on_progress(progress_);
  }

  void run_group(const GroupPlan& group, Result& out) {
    if (group.cases.empty()) return;
    try {
      measure_group(group, out);
    } catch (const Error& error) {
      throw Error(error.file(), group.cases.front().name + (error.where().empty() ? "" : ": " + error.where()),
                  error.message(), error.code());
    }
  }

  void measure_group(const GroupPlan& group, Result& out) {
    const SceneData& data = plan_.scenes[group.scene];
    const PathFrames path(data.scene, path_of(group), config_.viewports[group.viewport]);
    const double per_frame = accuracy_cost_of(group) / path.count();
    const AccuracyResult counted = accuracy_pass(
        config_, group, path, [&](int) { tell(group, "truth and counts", per_frame); }, stop_);
    if (!counted.is_complete) return;
    std::vector<std::optional<StabilityResult>> stabilities;
    if (config_.stability) {
      const double cost = stability_cost_of(group);
      stabilities = stability_pass(
          config_, group, path, [&](double share) { tell(group, "stability", cost * share); }, stop_);
      if (stabilities.empty()) return;
    }
    std::vector<std::optional<Details>> details;
    if (config_.details) {
      tell(group, "details", details_cost_of(group));
      details = details_pass(config_, group, path, data.scene, counted, stop_);
      if (details.empty()) return;
    }
    std::vector<TimingResult> timings;
    if (config_.timing.measure) {
      const double per_round = timing_cost(config_, group) / config_.timing.rounds;
      timings = timing_pass(
          config_, group, path, [&](int) { tell(group, "time", per_round); }, stop_);
      if (timings.empty()) return;
    }
    for (std::size_t i = 0; i < group.cases.size(); ++i) {
      CaseResult one = case_result(group.cases[i], path.count(), counted, i);
      if (!stabilities.empty()) one.stability = stabilities[i];
      if (!details.empty()) one.details = std::move(details[i]);
      if (!timings.empty()) one.timing = timings[i];
      if (const auto count = counts_.find(one.id); count != counts_.end()) one.count = count->second;
      ++progress_.cases_done;
      if (listener_.on_case) listener_.on_case(one);
      out.cases.push_back(std::move(one));
    }
  }

  CaseResult case_result(const CasePlan& plan, int frames, const AccuracyResult& counted, std::size_t place) const {
    const scene::Scene& scene = plan_.scenes[plan.scene].scene;
    const config::MethodRequest& assigner = config_.assigners[plan.assigner];
    const assign::AssignerDescriptor& descriptor = *assign::find_assigner(assigner.name);
    const MethodMeasures& method = *std::find_if(counted.methods.begin(), counted.methods.end(),
                                                 [&](const auto& one) { return one.method == plan.method(); });
    const StructureMeasures& structure = counted.structures[place];
    CaseResult out;
    out.id = plan.id;
    out.settings = plan.settings;
    out.name = plan.name;
    out.scene = scene.name;
    out.camera = plan_.scenes[plan.scene].paths[plan.camera].camera;
    out.viewport = config_.viewports[plan.viewport];
    out.frames = frames;
    out.grid = grid_facts(config_.grids[plan.grid], counted.last_grid);
    out.assigner = assigner.name;
    out.assigner_label = assigner.label();
    out.assigner_params = params_json(assigner.params);
    const config::PrecisionRequest& precision = config_.precisions[plan.precision];
    out.conservative =
        assign::is_conservative(descriptor, assigner.params) && (precision.inflate || !precision.is_lossy());
    if (!counted.losses.empty())
      out.precision = {view::packing_name(precision.packing), precision.label(), precision.inflate,
                       counted.losses[plan.precision]};
    out.exact = descriptor.exact;
    out.storage_label = storage_label(config_, plan);
    out.buffers = structure.buffers;
    out.tests_done = method.tests_done;
    out.fallbacks = method.fallbacks;
    if (method.has_cells) out.occupancy = method.occupancy;
    if (method.has_cells && config_.check_accuracy) out.error = method.error;
    if (out.error && out.error->deepest)
      out.deepest_miss_light = scene.lights[static_cast<std::size_t>(out.error->deepest->rig_index)].name;
    if (config_.shading_samples > 0) out.shading = structure.shading;
    out.worst_unlit = structure.worst_unlit;
    out.lookup = structure.lookup;
    out.failures = failures_of(out, config_.limits);
    return out;
  }

  const config::Config& config_;
  const Plan& plan_;
  std::set<std::string> done_;
  const Listener& listener_;
  const std::atomic<bool>& stop_;
  const Counts& counts_;
  Progress progress_;
};

}  // namespace

Result run_plan(const config::Config& config, const Plan& plan, const std::vector<std::string>& done,
                const Listener& listener, const std::atomic<bool>& stop, const Counts& counts) {
  return Run(config, plan, done, listener, stop, counts).result();
}

}  // namespace clusterbench::run
