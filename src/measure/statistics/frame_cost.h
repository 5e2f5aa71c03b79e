#pragma once
// What a frame costs with its shading, by a model: what is assigned, uploaded, read by samples and looped over, each at
// a constant's price.

#include <optional>
#include <vector>

#include "measure/statistics/time_statistics.h"

namespace clusterbench::measure {

struct CostModel {
  double ns_per_light = 0.0;                            // of one light at one sample
  double upload_gb_per_s = 1.0, memory_gb_per_s = 1.0;  // a GB/s is a byte per nanosecond
  // Of what samples read of a light structure to know their lights; 0 bytes per ns: reading is free.
  double ns_per_read = 0.0;    // of one element: a header, an index, a word of bits, a node that is visited
  double read_gb_per_s = 0.0;  // of their bytes
};

// Samples of one set, per frame.
struct ShadedSamples {
  double samples = 0.0;
  double lights = 0.0;      // looped over at one of them, mean
  double divergence = 1.0;  // how many times longer waves take than their lanes' mean
  double reads = 0.0;       // elements of the light structure that one of them fetches, mean
  double read_bytes = 0.0;  // their bytes

  double light_ns(const CostModel& model) const { return samples * lights * divergence * model.ns_per_light; }
  double read_ns(const CostModel& model) const;
  double ns(const CostModel& model) const { return light_ns(model) + read_ns(model); }
};

struct FrameCost {
  std::optional<double> assign_ns;  // none where nothing is timed
  double upload_ns = 0.0, traffic_ns = 0.0;
  double read_ns = 0.0;   // of samples, to know their lights
  double shade_ns = 0.0;  // of those lights

  double gpu_ns() const { return upload_ns + traffic_ns + read_ns + shade_ns; }
  std::optional<double> frame_ns() const { return assign_ns ? std::optional(*assign_ns + gpu_ns()) : std::nullopt; }
};

// Costs that differ by no more are alike: samples of some frames tell no less.
inline constexpr double k_alike_ratio = 1.05;
// Each price of the model can be so many times lower or higher on the GPU at hand.
inline constexpr double k_price_factor = 2.0;

// `numerator` / `denominator` as each price takes values within k_price_factor of the model's; measured times have
// none.
Interval ratio_by_prices(const FrameCost& numerator, const FrameCost& denominator);

// A range of ratios about `nominal`, of costs, as one about `measured`, the ratio of the same that was measured side by
// side: as many times as much.
Interval around(double measured, double nominal, const Interval& range);
// Whether what costs more costs no more at some of these prices.
bool turns_with_prices(const FrameCost& less, const FrameCost& more);

FrameCost frame_cost(const CostModel& model, std::optional<double> assign_ns, double upload_bytes, double traffic_bytes,
                     const std::vector<ShadedSamples>& sets);

}  // namespace clusterbench::measure
