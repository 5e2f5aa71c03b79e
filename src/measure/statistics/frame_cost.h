#pragma once
// A cost model of a frame with its shading: assignment, upload, reads by samples and light loops, each multiplied by a
// constant price.

#include <optional>
#include <vector>

#include "measure/statistics/time_statistics.h"

namespace clusterbench::measure {

struct CostModel {
  double ns_per_light = 0.0;                            // of one light at one sample
  double upload_gb_per_s = 1.0, memory_gb_per_s = 1.0;  // a GB/s is a byte per nanosecond
  // Reads of a light structure by samples, to find their lights; 0 bytes per ns: reads are free.
  double ns_per_read = 0.0;    // per element: a header, an index, a word of bits, a visited node
  double read_gb_per_s = 0.0;  // for their bytes
};

// Samples of one set, per frame.
struct ShadedSamples {
  double samples = 0.0;
  double lights = 0.0;      // loop iterations per sample, mean
  double divergence = 1.0;  // duration of a wave / mean of its lanes
  double reads = 0.0;       // elements of the light structure fetched per sample, mean
  double read_bytes = 0.0;  // their bytes

  double light_ns(const CostModel& model) const { return samples * lights * divergence * model.ns_per_light; }
  double read_ns(const CostModel& model) const;
  double ns(const CostModel& model) const { return light_ns(model) + read_ns(model); }
};

struct FrameCost {
  std::optional<double> assign_ns;  // none without timing
  double upload_ns = 0.0, traffic_ns = 0.0;
  double read_ns = 0.0;   // reads of samples to find their lights
  double shade_ns = 0.0;  // shading of those lights

  double gpu_ns() const { return upload_ns + traffic_ns + read_ns + shade_ns; }
  std::optional<double> frame_ns() const { return assign_ns ? std::optional(*assign_ns + gpu_ns()) : std::nullopt; }
};

// Costs within this ratio count as equal: samples of a few frames are not more precise.
inline constexpr double k_alike_ratio = 1.05;
// Each price of the model can be lower or higher by this factor on a real GPU.
inline constexpr double k_price_factor = 2.0;

// Range of `numerator` / `denominator` if each price varies by k_price_factor around the model's. Measured times do not
// vary.
Interval ratio_by_prices(const FrameCost& numerator, const FrameCost& denominator);

// Scales `range`, a range of cost ratios around `nominal`, to one around `measured`, the same ratio measured side by
// side.
Interval around(double measured, double nominal, const Interval& range);
// Whether the more expensive case costs no more at some of these prices.
bool turns_with_prices(const FrameCost& less, const FrameCost& more);

FrameCost frame_cost(const CostModel& model, std::optional<double> assign_ns, double upload_bytes, double traffic_bytes,
                     const std::vector<ShadedSamples>& sets);

}  // namespace clusterbench::measure
