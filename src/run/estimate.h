#pragma once
// About how long a plan takes, by a look at some frames of its groups.

#include <span>
#include <vector>

#include "run/cases/sweep.h"
#include "run/passes/timing_pass.h"
#include "run/runner.h"

namespace clusterbench::run {

// How much is looked at, and what of the times is to be measured.
struct Looks {
  double most_s = 6.0;             // no further group is looked at after so long
  int warm_rounds = k_all_rounds;  // of LaunchRequest
};

// Of each of the plan's groups; what the looks did not come to takes the median of the others.
std::vector<GroupCost> estimated_costs(const config::Config& config, const Plan& plan, const Looks& looks = {});

double sum_s(std::span<const GroupCost> costs);
double sum_of_timing_s(std::span<const GroupCost> costs);
double estimated_s(const config::Config& config, const Plan& plan);

}  // namespace clusterbench::run
