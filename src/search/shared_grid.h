#pragma once
// One camera's samples looked up in another camera's grid: two eyes that share the left one's lists, a mirror without
// lists of its own.

#include <atomic>

#include "config/config.h"
#include "measure/samples/shading.h"
#include "run/cases/plan.h"

namespace clusterbench::search {

// Over all frames: `samples` random points of the view of `guest` (index of a camera of the same scene), looked up in
// the case's structure in the same frame of its own camera. For points outside that camera's picture or behind it, the
// structure has no answer. Throws Error if the cameras have different numbers of frames, for methods that need depth
// and behind a pre-cull.
measure::ShadingCounts samples_in_grid_of(const config::Config& config, const run::Plan& plan,
                                          const run::CasePlan& case_plan, std::size_t guest, int samples,
                                          const std::atomic<bool>& stop);

}  // namespace clusterbench::search
