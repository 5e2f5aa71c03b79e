#pragma once
// The cost of frames for the page, by which conclusions choose.

#include <vector>

#include "result/documents/page.h"

namespace clusterbench::report {

// For the cases of a result: the time to make their lists (if timed) and the GPU's cost, by the model of config.cost.
// Without cases that lose lights, whose picture differs, and presets that were timed although their engines make lists
// on the GPU. Empty without a model or samples.
std::vector<result::FrameCost> page_costs(const result::Result& result);

}  // namespace clusterbench::report
