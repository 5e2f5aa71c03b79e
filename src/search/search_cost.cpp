#include "search/search_cost.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace clusterbench::search {
namespace {

// From each group the cases of two of its methods, and of another two in the next group: storages of one method share
// its cost.
std::vector<run::GroupPlan> with_two_methods(std::span<const run::GroupPlan> groups) {
  std::vector<run::GroupPlan> some(groups.begin(), groups.end());
  for (std::size_t i = 0; i < some.size(); ++i) {
    const std::vector<run::Method> methods = run::methods_of(some[i]);
    const run::Method &first = methods[i % methods.size()],
                      &second = methods[(i + methods.size() / 2) % methods.size()];
    std::erase_if(some[i].cases,
                  [&](const run::CasePlan& one) { return one.method() != first && one.method() != second; });
  }
  return some;
}

std::vector<run::GroupPlan> with_one_case(std::span<const run::GroupPlan> groups) {
  std::vector<run::GroupPlan> some(groups.begin(), groups.end());
  for (std::size_t i = 0; i < some.size(); ++i) some[i].cases = {some[i].cases[7 * i % some[i].cases.size()]};
  return some;
}

double case_count(std::span<const run::GroupPlan> groups) {
  double count = 0.0;
  for (const run::GroupPlan& group : groups) count += static_cast<double>(group.cases.size());
  return count;
}

// Means over the groups, per frame of counting and per case of timing.
struct MeanCosts {
  double cases = 0.0, counting_ns = 0.0, timing_ns = 0.0;
};

MeanCosts mean_costs(const config::Config& config, run::Plan& plan, std::vector<run::GroupPlan> groups,
                     const run::EstimateLimits& limits) {
  std::swap(plan.groups, groups);
  const std::vector<run::GroupCost> costs = run::estimated_costs(config, plan, limits);
  std::swap(plan.groups, groups);
  const auto count = static_cast<double>(groups.size());
  MeanCosts means;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const scene::CameraPath& path = plan.scenes[groups[i].scene].paths[groups[i].camera];
    const auto cases = static_cast<double>(groups[i].cases.size());
    means.cases += cases / count;
    means.counting_ns += costs[i].counting_ns / static_cast<double>(path.shots.size()) / count;
    means.timing_ns += costs[i].timing_ns / cases / count;
  }
  return means;
}

}  // namespace

double SearchCosts::counting_ns(std::size_t candidates, std::size_t grids, std::size_t frames) const {
  return static_cast<double>(frames) *
         (grid_ns * static_cast<double>(std::min(candidates, grids)) + candidate_ns * static_cast<double>(candidates));
}

double SearchCosts::rung_ns(std::size_t candidates, std::size_t grids, std::size_t frames) const {
  const std::size_t further = std::min(frames, timed_frames) - std::min<std::size_t>(1, timed_frames);
  return counting_ns(candidates, grids, frames) +
         static_cast<double>(candidates) * (first_frame_timing_ns + frame_timing_ns * static_cast<double>(further));
}

double SearchCosts::last_ns(std::size_t candidates, std::size_t grids, std::size_t frames) const {
  return counting_ns(candidates, grids, frames) + last_timing_ns * static_cast<double>(candidates);
}

double planned_ns(const SearchCosts& costs, const Halving& planned, std::size_t grids, std::size_t frames) {
  double ns = costs.last_ns(planned.finalists.size() + k_most_coarse, grids, frames);
  for (const Rung& rung : planned.rungs) ns += costs.rung_ns(rung.candidates, grids, rung.frames);
  return ns;
}

config::Config quickly_timed(config::Config config) {
  config.timing.rounds = std::min(config.timing.rounds, 3);
  config.timing.min_time_ms = std::min(config.timing.min_time_ms, 0.5);
  config.timing.launches = 1;
  return config;
}

SearchCosts sampled_costs(const config::Config& config, run::Plan& plan, std::span<const run::GroupPlan> groups,
                          double counted_share) {
  const std::vector<run::GroupPlan> of_two = with_two_methods(groups), of_one = with_one_case(groups);
  // Half of the sampling each, although both have only a part of the cases.
  const double half = 0.5 * counted_share * case_count(groups);
  const run::EstimateLimits of_two_limits{
      .most_s = 4.0, .counted_share = half / case_count(of_two), .warm_rounds = k_quick_warm_rounds},
      of_one_limits{.most_s = 2.0, .counted_share = half / case_count(of_one)};
  const MeanCosts some = mean_costs(quickly_timed(config), plan, of_two, of_two_limits),
                  one = mean_costs(config, plan, of_one, of_one_limits);
  SearchCosts costs;
  const double more_cases = std::max(1.0, some.cases - one.cases);
  costs.candidate_ns = std::max((some.counting_ns - one.counting_ns) / more_cases, 0.02 * some.counting_ns);
  costs.grid_ns = std::max(0.0, some.counting_ns - some.cases * costs.candidate_ns);
  costs.timed_frames = config.timing.measure ? static_cast<std::size_t>(config.timing.frames) : 0;
  // The fixed cost of a method and the frame with most pairs cost about as much as two frames.
  const double frames = static_cast<double>(costs.timed_frames) + 2.0;
  costs.frame_timing_ns = some.timing_ns / frames;
  costs.first_frame_timing_ns = 3.0 * costs.frame_timing_ns;
  costs.last_timing_ns = one.timing_ns;
  return costs;
}

}  // namespace clusterbench::search
