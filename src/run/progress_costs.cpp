#include "run/progress_costs.h"

#include <algorithm>

namespace clusterbench::run {

ProgressCosts::ProgressCosts(const config::Config& config, const Plan& plan, std::span<const GroupCost> measured)
    : config_(config), plan_(plan) {
  for (std::size_t i = 0; i < measured.size(); ++i) measured_[key_of(plan.groups[i])] = measured[i];
}

const GroupCost* ProgressCosts::measured_of(const GroupPlan& group) const {
  const auto found = measured_.find(key_of(group));
  return found == measured_.end() ? nullptr : &found->second;
}

std::size_t ProgressCosts::frames_of(const GroupPlan& group) const {
  return plan_.scenes[group.scene].paths[group.camera].shots.size();
}

double ProgressCosts::of_lists(const GroupPlan& group, double frames, double samples_per_frame) const {
  constexpr double k_ns_per_light = 2000.0, k_ns_per_brute_pair = 3.0, k_cells = 8000.0, k_ns_per_sample = 1000.0;
  const auto lights = static_cast<double>(plan_.scenes[group.scene].scene.lights.size());
  double per_frame = lights * k_ns_per_light + k_ns_per_sample * samples_per_frame;
  for (const Method& method : methods_of(group))
    per_frame += assign::find_assigner(config_.assigners[method.assigner].name)->all_pairs
                     ? lights * k_cells * k_ns_per_brute_pair
                     : 1e5;
  return per_frame * frames;
}

double ProgressCosts::counting(const GroupPlan& group) const {
  if (const GroupCost* cost = measured_of(group)) return cost->counting_ns;
  double samples = 0.0;
  for (const config::SampleSetRequest& request : config_.sample_sets)
    samples += request.most_samples(config_.viewports[group.viewport]);
  return of_lists(group, static_cast<double>(frames_of(group)), samples);
}

double ProgressCosts::stability(const GroupPlan& group) const {
  return config_.stability ? of_lists(group, config_.stability->steps, 0.0) : 0.0;
}

double ProgressCosts::details(const GroupPlan& group) const {
  if (!config_.details) return 0.0;
  const config::DetailsFrames& wanted = config_.details->frames;
  return of_lists(group, std::max({1, wanted.count, static_cast<int>(wanted.list.size())}), 0.0);
}

double ProgressCosts::device(const GroupPlan& group) const {
  const GroupPlan on_device = device_cases(config_, group);
  if (!config_.timing.measure || on_device.cases.empty()) return 0.0;
  if (const GroupCost* cost = measured_of(group)) return cost->device_ns;
  constexpr double k_ns_per_frame = 2e6;
  const auto frames = static_cast<double>(frames_of(group)), most = static_cast<double>(config_.timing.frames);
  const double timed = config_.timing.frames == 0 ? frames : std::min(frames, most);
  return k_ns_per_frame * timed * config_.timing.rounds * static_cast<double>(methods_of(on_device).size());
}

double ProgressCosts::reading(const GroupPlan& group) const {
  if (config_.reading_sets.empty()) return 0.0;
  if (const GroupCost* cost = measured_of(group)) return cost->reading_ns;
  constexpr double k_ns_per_reading = 2e6;
  return k_ns_per_reading * config_.reading->frames * config_.reading->rounds *
         static_cast<double>(config_.reading_sets.size() * config_.reading->walks.size() * group.cases.size());
}

double ProgressCosts::timing(const GroupPlan& group) const {
  const GroupPlan timed = timed_cases(config_, group);
  if (!config_.timing.measure || timed.cases.empty()) return 0.0;
  if (const GroupCost* cost = measured_of(group)) return cost->timing_ns;
  constexpr double k_ns_per_cold_frame = 2e6;
  const double warm = 1.5e6 * config_.timing.min_time_ms, cold = config_.timing.cold ? 4.0 * k_ns_per_cold_frame : 0.0;
  return (warm + cold) * config_.timing.rounds * static_cast<double>(methods_of(timed).size());
}

double ProgressCosts::all(const GroupPlan& group) const {
  return counting(group) + stability(group) + details(group) + device(group) + reading(group) + timing(group);
}

}  // namespace clusterbench::run
