#pragma once
// What a run found, as the records of a result (result/case.h): figures are rounded, cells have coordinates, shares and
// means are made of counts.

#include <cstdint>
#include <vector>

#include "result/result.h"
#include "run/findings/run_result.h"

namespace clusterbench::run {

result::Case record_of(const CaseResult& found);
result::Scene record_of(const SceneResult& scene);
result::Tool record_of(const ToolFacts& tool);
result::Machine record_of(const MachineFacts& machine);

}  // namespace clusterbench::run
