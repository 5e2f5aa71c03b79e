#pragma once
// Lists and truth along a finely sampled piece of the path: changes from step to step, and changes back.

#include <functional>
#include <optional>

#include "core/stop.h"
#include "run/cases/case_plan.h"
#include "run/cases/path_frames.h"
#include "run/findings/run_result.h"

namespace clusterbench::run {

// One result per case of the group, none for methods without cells; empty if stopped before the end. Config::stability
// is set. `on_step` gets each step's share of the whole pass.
std::vector<std::optional<StabilityResult>> stability_pass(const config::Config& config, const GroupPlan& group,
                                                           const PathFrames& path,
                                                           const std::function<void(double share)>& on_step,
                                                           const Stop& stop);

}  // namespace clusterbench::run
