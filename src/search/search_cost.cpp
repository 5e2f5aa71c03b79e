#include "search/search_cost.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace clusterbench::search {
namespace {

// With at least two methods of each group, and with more if all of a group on each thread are no more than a tenth of
// all groups' methods.
std::vector<run::GroupPlan> with_some_methods(std::span<const run::GroupPlan> groups, int threads) {
  std::vector<run::GroupPlan> some(groups.begin(), groups.end());
  std::size_t all = 0;
  for (const run::GroupPlan& group : groups) all += run::methods_of(group).size();
  const std::size_t most = std::max<std::size_t>(2, all / (10 * static_cast<std::size_t>(threads)));
  for (std::size_t i = 0; i < some.size(); ++i) {
    const std::vector<run::Method> methods = run::methods_of(some[i]);
    if (methods.size() <= most) continue;
    std::vector<run::Method> kept;  // spread over all, and others in the next group
    for (std::size_t k = 0; k < most; ++k) kept.push_back(methods[(i + k * methods.size() / most) % methods.size()]);
    std::erase_if(some[i].cases,
                  [&](const run::CasePlan& one) { return std::ranges::find(kept, one.method()) == kept.end(); });
  }
  return some;
}

std::vector<run::GroupPlan> with_one_case(std::span<const run::GroupPlan> groups) {
  std::vector<run::GroupPlan> some(groups.begin(), groups.end());
  for (std::size_t i = 0; i < some.size(); ++i) some[i].cases = {some[i].cases[7 * i % some[i].cases.size()]};
  return some;
}

// Means over the groups, of counting one frame and per case of timing.
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
    const auto cases = static_cast<double>(groups[i].cases.size());
    means.cases += cases / count;
    means.counting_ns += costs[i].counting_ns / count;
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
                          double times_counted) {
  // Each of about as many groups, since it takes the same share of its own counting.
  run::EstimateLimits limits{.most_s = 4.0,
                             .counts_one_frame = true,
                             .times_counted = 0.8 * times_counted,
                             .warm_rounds = k_quick_warm_rounds};
  const MeanCosts whole = mean_costs(quickly_timed(config), plan, with_some_methods(groups, config.threads), limits);
  limits.most_s = 2.0;
  limits.warm_rounds = run::k_all_rounds;
  const MeanCosts one = mean_costs(config, plan, with_one_case(groups), limits);
  SearchCosts costs;
  const double more_cases = std::max(1.0, whole.cases - one.cases);
  costs.candidate_ns =
      std::max((whole.counting_ns - one.counting_ns) / more_cases, 0.02 * whole.counting_ns / whole.cases);
  costs.grid_ns = std::max(0.0, whole.counting_ns - whole.cases * costs.candidate_ns);
  costs.timed_frames = config.timing.measure ? static_cast<std::size_t>(config.timing.frames) : 0;
  // The fixed cost of a method and the frame with most pairs cost about as much as two frames.
  const double frames = static_cast<double>(costs.timed_frames) + 2.0;
  costs.frame_timing_ns = whole.timing_ns / frames;
  costs.first_frame_timing_ns = 3.0 * costs.frame_timing_ns;
  costs.last_timing_ns = one.timing_ns;
  return costs;
}

}  // namespace clusterbench::search
