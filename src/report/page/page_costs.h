#pragma once
// The cost of frames for the page, by which conclusions choose.

#include <nlohmann/json.hpp>

#include "result/result.h"

namespace clusterbench::report {

// [{"id", "ns", "gpu_ns"}] for the cases of a result: the time to make their lists (if timed) and the GPU's cost, by
// the model of config.cost. Without cases that lose lights, whose picture differs, and presets that were timed although
// their engines make lists on the GPU. Empty without a model or samples.
nlohmann::ordered_json page_costs(const result::Result& result);

}  // namespace clusterbench::report
