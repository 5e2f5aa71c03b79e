#pragma once
// The first pass over a group's frames: lists against truth, occupancy, buffers, shading. Nothing is timed before it.

#include <atomic>
#include <functional>
#include <memory>

#include "run/path_frames.h"
#include "run/result.h"
#include "run/sweep.h"

namespace clusterbench::run {

// What one method's lists say, whatever they are stored in.
struct ListMeasures {
  Method method;
  measure::Occupancy occupancy;
  measure::ErrorCounts error;
  measure::ShadingCounts shading;
  std::vector<measure::LookupCounts> lookup;
  std::uint64_t tests_done = 0, fallbacks = 0;
};

struct AccuracyResult {
  std::vector<ListMeasures> lists;           // one per method of the group, in order of first use
  std::vector<measure::Buffers> buffers;     // one per case of the group
  std::vector<measure::PackingLoss> losses;  // one per precision of the configuration; none if it has float32 alone
  grid::Grid last_grid;
  bool is_complete = false;  // false: stopped before the end
};

AccuracyResult accuracy_pass(const Config& config, const GroupPlan& group, const PathFrames& path,
                             const std::function<void(int frame)>& on_frame, const std::atomic<bool>& stop);

}  // namespace clusterbench::run
