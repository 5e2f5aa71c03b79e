#pragma once
// What samples pay for their lights: a device looks up the list of each sample of some frames and walks it, timed by
// its own clock, beside the exact lists and beside reading nothing. All of a group's structures take turns.

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "run/cases/case_plan.h"
#include "run/cases/path_frames.h"
#include "run/cases/scene_data.h"
#include "run/findings/run_result.h"

namespace clusterbench::run {

struct ReadCase {
  std::optional<ReadingResult> reading;
  std::string obstacle;  // why there is none
};

// One for each case of the group; empty if stopped before the end. Where the device fails, or a structure exceeds its
// limits or those of the configuration, each case is read alone, and those that fail alone are not.
std::vector<ReadCase> reading_pass(const config::Config& config, const SceneData& data, const GroupPlan& group,
                                   const PathFrames& path, const std::atomic<bool>& stop);

}  // namespace clusterbench::run
