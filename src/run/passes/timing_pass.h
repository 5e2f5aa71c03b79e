#pragma once
// The second pass: the group's assigners in interleaved rounds, each round in a different order, so that disturbances
// of the machine affect all of them equally and ratios can be computed pair by pair.
//
// Timed frames: `timing.frames` frames, evenly spaced over the path, are in the means, since they represent it. The
// path's frame with the most pairs of a method, known from the accuracy pass, is timed too, but counts only as a
// candidate for the worst frame. So a few frames do not look better than all, and the mean is not biased towards chosen
// frames.
//
// Cold: before each frame the caches are swept (cache_sweep.h), then the frame is assigned and converted once. Warm:
// the same frames repeatedly, for at least `timing.min_time_ms`.
//
// Processes of one program differ more than rounds within one process (memory addresses, time of day). So several
// processes measure, and the statistics know the process of each round (measure/statistics/time_statistics.h).

#include <atomic>
#include <functional>
#include <limits>
#include <span>

#include "run/cases/case_plan.h"
#include "run/cases/path_frames.h"
#include "run/findings/run_result.h"
#include "run/timing/timing_samples.h"

namespace clusterbench::run {

// Number of rounds per launch: together at least the requested number.
int rounds_per_launch(const config::TimingRequest& timing, int launches);

// The order in which a launch measures the methods in a round: shuffled by the seed, and each order is followed by its
// reverse, so that neighbours change and no method is always early.
std::vector<std::size_t> method_order(std::size_t methods, std::uint64_t seed, int launch, int round);

inline constexpr int k_all_rounds = std::numeric_limits<int>::max();

struct LaunchRequest {
  int launch = 0, rounds = 1;        // index of the launch; the order of methods follows from it and the seed
  std::vector<int> fullest_frames;   // per method of the group: its frame with the most pairs; -1: unknown
  std::function<void()> sweep = {};  // empties the caches; if not set, the caches of this machine
  // number of first rounds with warm times; with cold caches, the other rounds are cold only
  int warm_rounds = k_all_rounds;
};

// The samples of this process; no methods if stopped before the end.
GroupSamples measure_launch(const config::Config& config, const GroupPlan& group, const PathFrames& path,
                            const LaunchRequest& request, const std::function<void(int round)>& on_round,
                            const std::atomic<bool>& stop);

// One timing per case of the group, from at least one launch. All launches have measured the same number of rounds.
std::vector<TimingResult> timing_results(const config::Config& config, const GroupPlan& group,
                                         std::span<const GroupSamples> launches);

}  // namespace clusterbench::run
