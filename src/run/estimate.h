#pragma once
// About how long a plan takes, by a look at some frames of its groups.

#include <span>
#include <vector>

#include "run/runner.h"
#include "run/sweep.h"

namespace clusterbench::run {

// Of each of the plan's groups. Looks at them for a few seconds at most; what it did not come to takes the median of
// the others.
std::vector<GroupCost> estimated_costs(const config::Config& config, const Plan& plan);

double sum_s(std::span<const GroupCost> costs);
double estimated_s(const config::Config& config, const Plan& plan);

}  // namespace clusterbench::run
