#pragma once
// Times of methods that run on a device, by the device's own clock: rounds in which they take turns in changing order
// (method_order() of timing_pass.h), each followed by its floor. In this process, which has the device open.

#include <atomic>
#include <functional>
#include <optional>
#include <vector>

#include "run/cases/case_plan.h"
#include "run/cases/path_frames.h"
#include "run/findings/run_result.h"

namespace clusterbench::run {

// One for each case of the group, whose methods all run on the device, none where it has no clock; empty if stopped
// before the end. `on_round` is called behind each round.
std::vector<std::optional<DeviceTimes>> device_pass(const config::Config& config, const GroupPlan& group,
                                                    const PathFrames& path, const std::function<void()>& on_round,
                                                    const std::atomic<bool>& stop);

}  // namespace clusterbench::run
