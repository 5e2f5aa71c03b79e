#pragma once
// Estimated duration of a search for the best clustering, from some of its candidates on some frames.

#include <cstddef>
#include <span>

#include "run/estimate.h"
#include "search/halving.h"

namespace clusterbench::search {

// In nanoseconds; the defaults give every candidate on a frame the same cost, without timing.
struct SearchCosts {
  double grid_ns = 0.0;       // a frame of a grid: its depths, truth and samples
  double candidate_ns = 1.0;  // a frame of a candidate: its lists, and their lights at samples
  // Per timed candidate: a few rounds on one frame, on each further frame, and the final timing on all frames.
  double first_frame_timing_ns = 0.0, frame_timing_ns = 0.0, last_timing_ns = 0.0;
  std::size_t timed_frames = 0;  // maximum number of timed frames

  // For this many candidates, with at most this many grids, on some frames.
  double counting_ns(std::size_t candidates, std::size_t grids, std::size_t frames) const;
  double rung_ns(std::size_t candidates, std::size_t grids, std::size_t frames) const;
  double last_ns(std::size_t candidates, std::size_t grids, std::size_t frames) const;  // on all frames
};

// In addition to the finalists of halving, at most this many candidates of coarse grids are measured on all frames.
inline constexpr std::size_t k_most_coarse = 4;

// Upper bound of the planned cost on all frames.
double planned_ns(const SearchCosts& costs, const Halving& planned, std::size_t grids, std::size_t frames);

// Few rounds in this process: enough to find the better share.
config::Config quickly_timed(config::Config config);
inline constexpr int k_quick_warm_rounds = 1;

// For groups with one grid each on a camera. `times_counted`: how often the search counts a frame of all of them. Of
// first frames alone, in which memory grows: for more than one frame that is an upper estimate. Samples for about a
// tenth of the search and a few seconds at most, but at least one group on each thread. `plan` is unchanged afterwards.
SearchCosts sampled_costs(const config::Config& config, run::Plan& plan, std::span<const run::GroupPlan> groups,
                          double times_counted);

}  // namespace clusterbench::search
