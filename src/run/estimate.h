#pragma once
// About how long a plan takes, for who decides whether to begin: one frame of some groups is made, counted and timed.

#include "run/sweep.h"

namespace clusterbench::run {

// In seconds, of this machine as busy as it is now; instructions (`--count`) and a baseline are not in it. Takes some
// seconds itself if the plan takes minutes.
double estimated_s(const config::Config& config, const Plan& plan);

}  // namespace clusterbench::run
