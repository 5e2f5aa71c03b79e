#pragma once
// The records of a result (result/case.h) from the results of a run: figures are rounded, cells have coordinates,
// shares and means are computed from counts.

#include <cstdint>
#include <vector>

#include "result/result.h"
#include "run/findings/run_result.h"

namespace clusterbench::run {

result::Case record_of(const CaseResult& found);
result::Scene record_of(const SceneResult& scene);
result::Tool record_of(const ToolFacts& tool);
result::Plugin record_of(const plugin::LoadedPlugin& loaded);
result::Machine record_of(const MachineFacts& machine);
result::Shard record_of(const PlannedShard& shard);
result::Device record_of(const gpu::DeviceFacts& device);
result::DeviceArithmetic record_of(const gpu::Arithmetic& found);

}  // namespace clusterbench::run
