#pragma once
// Estimates of work in nanoseconds, for nothing but the remaining time that is shown.

#include <cstddef>

#include "config/config.h"
#include "run/cases/plan.h"

namespace clusterbench::run {

// Truth, `samples` samples of each frame, and lists.
double list_cost(const config::Config& config, const GroupPlan& group, std::size_t lights, int frames, double samples);
double timing_cost(const config::Config& config, const GroupPlan& group);
// `on_device`: the group's cases there.
double device_cost(const config::Config& config, const GroupPlan& on_device, double frames);
double reading_cost(const config::Config& config, const GroupPlan& group);

}  // namespace clusterbench::run
