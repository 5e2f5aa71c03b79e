#pragma once
// What frames cost, for the page: by this conclusions choose.

#include <nlohmann/json.hpp>

#include "result/result.h"

namespace clusterbench::report {

// [{"id", "ns", "gpu_ns"}] of the cases of a result: making their lists (where that was timed) and what the GPU does,
// by the model of config.cost. None of cases that lose lights, whose picture is another one, of presets that were timed
// though their engines make lists on the GPU, and without a model or samples.
nlohmann::ordered_json page_costs(const result::Result& result);

}  // namespace clusterbench::report
