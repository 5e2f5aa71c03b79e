#pragma once
// The second pass: the group's assigners in interleaved rounds, each round in an order of its own, so that whatever
// disturbs the machine hits them alike and ratios can be taken pair by pair.
//
// Which frames are timed: those that `timing.frames` spaces evenly over the path are in the means, since they stand for
// it. The path's frame with the most pairs of a method, known from the accuracy pass, is timed beside them and takes
// part in the worst frame alone: so a few frames do not look better than all, and the mean is not one of chosen frames.
//
// Cold: before each frame the caches are swept (cache_sweep.h), then the frame is assigned and converted once. Warm:
// the same frames again and again, for as long as `timing.min_time_ms`.
//
// Processes of one program differ by more than rounds within one do (where memory lies, when it runs), so that several
// measure, and what is computed knows which round is of which (measure/statistics/time_statistics.h).

#include <atomic>
#include <functional>
#include <limits>
#include <span>

#include "run/cases/path_frames.h"
#include "run/cases/sweep.h"
#include "run/findings/run_result.h"
#include "run/timing/timing_samples.h"

namespace clusterbench::run {

// How many rounds each of the launches has: together at least as many as are asked for.
int rounds_per_launch(const config::TimingRequest& timing, int launches);

// In which order a launch measures the methods in a round: shuffled by the seed, and each order is followed by its
// reverse, so that neighbours change and nobody is always early.
std::vector<std::size_t> method_order(std::size_t methods, std::uint64_t seed, int launch, int round);

inline constexpr int k_all_rounds = std::numeric_limits<int>::max();

struct LaunchRequest {
  int launch = 0, rounds = 1;        // which it is; the order of methods follows from it and the seed
  std::vector<int> fullest_frames;   // per method of the group: its frame with the most pairs; -1: none is known
  std::function<void()> sweep = {};  // empties the caches; without one those of this machine
  int warm_rounds = k_all_rounds;    // of the first ones; where caches are cold, further rounds are so alone
};

// What this process measures; nothing of methods if stopped before the end.
GroupSamples measure_launch(const config::Config& config, const GroupPlan& group, const PathFrames& path,
                            const LaunchRequest& request, const std::function<void(int round)>& on_round,
                            const std::atomic<bool>& stop);

// One timing per case of the group, from at least one launch. All launches have measured the same number of rounds.
std::vector<TimingResult> timing_results(const config::Config& config, const GroupPlan& group,
                                         std::span<const GroupSamples> launches);

}  // namespace clusterbench::run
