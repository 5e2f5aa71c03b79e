#include "measure/statistics/frame_cost.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace clusterbench::measure {

double ShadedSamples::read_ns(const CostModel& model) const {
  const double bytes_ns = model.read_gb_per_s > 0.0 ? read_bytes / model.read_gb_per_s : 0.0;
  return samples * divergence * (reads * model.ns_per_read + bytes_ns);
}

Interval ratio_by_prices(const FrameCost& numerator, const FrameCost& denominator) {
  constexpr double FrameCost::*k_priced[] = {&FrameCost::upload_ns, &FrameCost::traffic_ns, &FrameCost::read_ns,
                                             &FrameCost::shade_ns};
  Interval ratios{std::numeric_limits<double>::infinity(), 0.0};
  // A ratio of two sums has its extremes at the extremes of the prices.
  for (unsigned corner = 0; corner < 1u << std::size(k_priced); ++corner) {
    double above = numerator.assign_ns.value_or(0.0), below = denominator.assign_ns.value_or(0.0);
    for (unsigned i = 0; i < std::size(k_priced); ++i) {
      const double price = (corner >> i & 1) != 0 ? k_price_factor : 1.0 / k_price_factor;
      above += price * numerator.*k_priced[i];
      below += price * denominator.*k_priced[i];
    }
    const double ratio = below > 0.0 ? above / below : above > 0.0 ? std::numeric_limits<double>::infinity() : 1.0;
    ratios = {std::min(ratios.low, ratio), std::max(ratios.high, ratio)};
  }
  return ratios;
}

Interval around(double measured, double nominal, const Interval& range) {
  if (!(nominal > 0.0) || !std::isfinite(measured) || !std::isfinite(nominal)) return range;
  return {range.low * measured / nominal, range.high * measured / nominal};
}

bool turns_with_prices(const FrameCost& less, const FrameCost& more) {
  return ratio_by_prices(more, less).low <= 1.0;
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
