#pragma once
// What a frame costs with its shading, by a model: what is assigned, uploaded and looped over, each at a constant's
// price.

#include <optional>
#include <vector>

namespace clusterbench::measure {

struct CostModel {
  double ns_per_light = 0.0;                            // of one light at one sample
  double upload_gb_per_s = 1.0, memory_gb_per_s = 1.0;  // a GB/s is a byte per nanosecond
};

// Samples of one set, per frame.
struct ShadedSamples {
  double samples = 0.0;
  double lights = 0.0;      // looped over at one of them, mean
  double divergence = 1.0;  // how many times longer waves take than their lanes' mean

  double ns(const CostModel& model) const { return samples * lights * divergence * model.ns_per_light; }
};

struct FrameCost {
  std::optional<double> assign_ns;  // none where nothing is timed
  double upload_ns = 0.0, traffic_ns = 0.0, shade_ns = 0.0;

  double gpu_ns() const { return upload_ns + traffic_ns + shade_ns; }
  std::optional<double> frame_ns() const { return assign_ns ? std::optional(*assign_ns + gpu_ns()) : std::nullopt; }
};

FrameCost frame_cost(const CostModel& model, std::optional<double> assign_ns, double upload_bytes, double traffic_bytes,
                     const std::vector<ShadedSamples>& sets);

}  // namespace clusterbench::measure
