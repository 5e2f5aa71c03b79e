#pragma once
// What samples pay for their lights: a device looks up the list of each sample of some frames and walks it, timed by
// its own clock, beside the exact lists and beside reading nothing. All of a group's structures take turns.

#include <atomic>
#include <optional>
#include <vector>

#include "run/cases/case_plan.h"
#include "run/cases/path_frames.h"
#include "run/cases/scene_data.h"
#include "run/findings/run_result.h"

namespace clusterbench::run {

// One for each case of the group; none for structures that no shader reads, for sets that are empty in all frames, and
// where the device has no clock. Empty if stopped before the end. Throws gpu::DeviceError if the device fails.
std::vector<std::optional<ReadingResult>> reading_pass(const config::Config& config, const SceneData& data,
                                                       const GroupPlan& group, const PathFrames& path,
                                                       const std::atomic<bool>& stop);

}  // namespace clusterbench::run
