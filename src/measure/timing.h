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

// The frame that takes longest of a pass over several frames.
struct WorstFrame {
  std::size_t place = 0;  // in the pass
  double ns = 0.0;        // median over the rounds
  Interval ci95;
};
// `frames_ns`: of each round, what each frame took; only its share of them counts. `pass_ns`: of each round, the mean
// of a frame, measured over the pass as a whole. So of one frame alone the worst is the mean. At least one round.
WorstFrame worst_frame(std::span<const std::vector<double>> frames_ns, std::span<const double> pass_ns,
                       std::uint64_t seed);

}  // namespace clusterbench::measure
