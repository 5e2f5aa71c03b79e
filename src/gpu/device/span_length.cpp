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

std::uint32_t cold_repeats_for(double once_ns, double timestamp_period_ns, std::uint64_t flushed_bytes) {
  constexpr double k_most_spans = 20.0;  // of three marks each
  const double flush_ns = static_cast<double>(flushed_bytes) / k_flushed_bytes_per_ns;
  const double fitting = std::min(k_most_spans, std::floor(k_longest_submit_ns / (once_ns + flush_ns)));
  const std::uint32_t wanted = repeats_for(once_ns, timestamp_period_ns, k_longest_submit_ns);
  return static_cast<std::uint32_t>(std::clamp(fitting, 1.0, static_cast<double>(wanted)));
}

}  // namespace clusterbench::gpu
