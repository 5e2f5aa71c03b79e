#include "gpu/device/span_length.h"

#include <algorithm>
#include <cmath>

namespace clusterbench::gpu {
namespace {

constexpr double k_least_periods = 1000.0, k_least_ns = 20'000.0, k_most_repeats = 10'000.0;

}  // namespace

double least_span_ns(double timestamp_period_ns) {
  return std::max(k_least_periods * timestamp_period_ns, k_least_ns);
}

std::uint32_t repeats_for(double once_ns, double timestamp_period_ns, double longest_ns) {
  const double least = least_span_ns(timestamp_period_ns), one = std::max(once_ns, timestamp_period_ns);
  if (!(one > 0.0)) return 1;
  const double most = std::max(1.0, std::floor(longest_ns / one));
  return static_cast<std::uint32_t>(std::clamp(std::ceil(least / one), 1.0, std::min(most, k_most_repeats)));
}

}  // namespace clusterbench::gpu
