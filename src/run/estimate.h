#pragma once
// Estimated duration of a plan, from a few sampled frames of its groups.

#include <span>
#include <vector>

#include "run/cases/plan.h"
#include "run/passes/timing_pass.h"
#include "run/runner.h"

namespace clusterbench::run {

// Limits of the sampling, and the times to be estimated.
struct EstimateLimits {
  double most_s = 6.0;             // no further group is sampled after this time; at least one is on each thread
  bool counts_one_frame = false;   // of each path, in place of all
  double times_counted = 1.0;      // how often such counting of the plan is going to be done
  int warm_rounds = k_all_rounds;  // see LaunchRequest
};

// One cost per group of the plan. Groups that were not sampled get those of the others: the counting for their
// predicted work (run/shards.h), and medians of a method that is timed, or of a group. Groups that fail have a part in
// no mean.
std::vector<GroupCost> estimated_costs(const config::Config& config, const Plan& plan,
                                       const EstimateLimits& limits = {});

double sum_s(std::span<const GroupCost> costs);
double sum_of_timing_s(std::span<const GroupCost> costs);
double estimated_s(const config::Config& config, const Plan& plan);

}  // namespace clusterbench::run
