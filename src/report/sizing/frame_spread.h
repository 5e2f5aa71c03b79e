#pragma once
// The needs of a buffer over the frames of its camera paths.

#include <cstdint>
#include <optional>
#include <vector>

#include "report/sizing/case_buffers.h"

namespace clusterbench::report {

// Of the frames of all cameras, each counted once. Upper bounds if an entry stands for several frames: it counts for
// each of them.
struct FrameSpread {
  std::uint64_t min = 0, p50 = 0, p90 = 0, p99 = 0, max = 0;  // nearest rank
  bool is_exact = true;                                       // every entry is one frame
};

// nullopt if no path has frames.
std::optional<FrameSpread> spread_of(const std::vector<PathNeed>& paths);

// The maximum over every 8th (4th, 2nd, each) frame: while it grows, frames between the counted ones need more.
struct Growth {
  int every = 1;
  std::uint64_t high_water = 0;
};
// Every 8th frame first. Empty for paths of at most 8 frames, and if some frames are unknown or merged.
std::vector<Growth> growth_of(const std::vector<PathNeed>& paths);

}  // namespace clusterbench::report
