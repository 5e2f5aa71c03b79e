#include "measure/frame_cost.h"

namespace clusterbench::measure {

FrameCost frame_cost(const CostModel& model, std::optional<double> assign_ns, double upload_bytes, double traffic_bytes,
                     const std::vector<ShadedSamples>& sets) {
  FrameCost cost{assign_ns, upload_bytes / model.upload_gb_per_s, traffic_bytes / model.memory_gb_per_s};
  for (const ShadedSamples& set : sets) cost.shade_ns += set.ns(model);
  return cost;
}

}  // namespace clusterbench::measure
