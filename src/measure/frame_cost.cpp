#include "measure/frame_cost.h"

namespace clusterbench::measure {

double ShadedSamples::read_ns(const CostModel& model) const {
  const double bytes_ns = model.read_gb_per_s > 0.0 ? read_bytes / model.read_gb_per_s : 0.0;
  return samples * divergence * (reads * model.ns_per_read + bytes_ns);
}

FrameCost frame_cost(const CostModel& model, std::optional<double> assign_ns, double upload_bytes, double traffic_bytes,
                     const std::vector<ShadedSamples>& sets) {
  FrameCost cost{assign_ns, upload_bytes / model.upload_gb_per_s, traffic_bytes / model.memory_gb_per_s};
  for (const ShadedSamples& set : sets) {
    cost.read_ns += set.read_ns(model);
    cost.shade_ns += set.light_ns(model);
  }
  return cost;
}

}  // namespace clusterbench::measure
