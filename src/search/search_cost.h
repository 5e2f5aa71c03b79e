#pragma once
// About how long a search for the best clustering takes, by a look at some of its candidates on some frames.

#include <cstddef>
#include <span>

#include "run/estimate.h"
#include "search/halving.h"

namespace clusterbench::search {

// In nanoseconds; as they are here, every candidate on a frame is worth the same, and nothing is timed.
struct SearchCosts {
  double grid_ns = 0.0;       // a frame of a grid: its depths, truth and samples
  double candidate_ns = 1.0;  // a frame of a candidate beside that: its lists, and what samples find in them
  // Of each candidate that is timed: in few rounds on one frame and on each more, and of the last ones on all frames.
  double first_frame_timing_ns = 0.0, frame_timing_ns = 0.0, last_timing_ns = 0.0;
  std::size_t timed_frames = 0;  // no more frames than this are timed

  // Of so many candidates, which have at most so many grids, on some frames.
  double counting_ns(std::size_t candidates, std::size_t grids, std::size_t frames) const;
  double rung_ns(std::size_t candidates, std::size_t grids, std::size_t frames) const;
  double last_ns(std::size_t candidates, std::size_t grids, std::size_t frames) const;  // on all frames
};

// Besides what halving leaves, so many candidates of coarse grids are measured on all frames.
inline constexpr std::size_t k_most_coarse = 4;

// The most that is planned, of all frames.
double planned_ns(const SearchCosts& costs, const Halving& planned, std::size_t grids, std::size_t frames);

// Few rounds of this process: enough to tell which share is the better one.
config::Config quickly_timed(config::Config config);
inline constexpr int k_quick_warm_rounds = 1;

// Of groups with one grid each on a camera. `plan` is as it was afterwards. Takes a few seconds.
SearchCosts looked_at(const config::Config& config, run::Plan& plan, std::span<const run::GroupPlan> groups);

}  // namespace clusterbench::search
