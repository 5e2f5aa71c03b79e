#pragma once
// The second pass: the group's assigners in interleaved rounds of alternating order, so that whatever disturbs the
// machine hits them alike and ratios can be taken pair by pair.

#include <atomic>
#include <functional>

#include "run/path_frames.h"
#include "run/result.h"
#include "run/sweep.h"

namespace clusterbench::run {

// One timing per case of the group; empty if stopped before the end.
std::vector<TimingResult> timing_pass(const config::Config& config, const GroupPlan& group, const PathFrames& path,
                                      const std::function<void(int round)>& on_round, const std::atomic<bool>& stop);

}  // namespace clusterbench::run
