#pragma once
// Times of methods that run on a device, by the device's own clock: rounds in which they take turns in changing order
// (method_order() of timing_pass.h), each beside its floor. Frames are repeated until a span is long enough
// (gpu/device/span_length.h).
//
// In this process, which opens the device anew for each launch: times of one opening (where buffers lie, how shaders
// were compiled) have more in common than those of two, as times of one process have on the processor.

#include <atomic>
#include <functional>
#include <optional>
#include <vector>

#include "run/cases/case_plan.h"
#include "run/cases/path_frames.h"
#include "run/findings/run_result.h"

namespace clusterbench::run {

// One for each case of the group, whose methods all run on the device, none where it has no clock; empty if stopped
// before the end. Nothing else may use the device: it is closed between launches. `on_round` is called behind each
// round.
std::vector<std::optional<DeviceTimes>> device_pass(const config::Config& config, const GroupPlan& group,
                                                    const PathFrames& path, int launches,
                                                    const std::function<void()>& on_round,
                                                    const std::atomic<bool>& stop);

}  // namespace clusterbench::run
