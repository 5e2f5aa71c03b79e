#pragma once
// Statistics of times: robust, paired, with bootstrap intervals. Pure functions; the clock is in the runner.

#include <cstdint>
#include <span>
#include <vector>

namespace clusterbench::measure {

struct Interval {
  double low = 0.0, high = 0.0;
};

struct TimeStats {
  double median = 0.0, mad = 0.0, min = 0.0, p95 = 0.0;
  Interval ci95;                // bootstrap interval of the median
  std::vector<double> samples;  // raw, in the order measured
};

// Seeded: the same samples give the same interval. An empty span gives zeros.
TimeStats time_stats(std::span<const double> samples_ns, std::uint64_t seed);

struct Ratio {
  double ratio = 0.0;
  Interval ci95;
};
// Median of the paired ratios numerator[i] / denominator[i], with its bootstrap interval. Both spans are equally long.
Ratio paired_ratio(std::span<const double> numerator, std::span<const double> denominator, std::uint64_t seed);

}  // namespace clusterbench::measure
