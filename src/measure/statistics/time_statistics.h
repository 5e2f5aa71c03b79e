#pragma once
// Statistics of times: robust, paired, with bootstrap intervals. Pure functions; the clock is in the runner.

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace clusterbench::measure {

// Unknown (NaN) by default.
struct Interval {
  static constexpr double k_unknown = std::numeric_limits<double>::quiet_NaN();

  double low = k_unknown, high = k_unknown;

  bool is_known() const { return low <= high; }
};

struct TimeStats {
  double median = 0.0, mad = 0.0, min = 0.0, p95 = 0.0;
  Interval ci95;                // bootstrap interval of the median
  std::vector<double> samples;  // raw, in the order measured
};

// A launch with fewer rounds has no interval: even the range of five rounds has a confidence of only 94 %.
inline constexpr std::size_t k_least_rounds = 6;

// `launches`: number of measuring processes, each with an equal share of the samples, one after the other. From three
// launches on (k_least_freedom in measure/statistics/time_change.h) the interval is Student's t of the logarithms of
// the launches' medians: the number of launches counts, not that of rounds, since rounds of one launch share its
// deviation. With one launch of at least k_least_rounds it is the bootstrap of the rounds, valid within that process
// only. Otherwise it is unknown. A known interval always contains the median. Seeded: the same samples give the same
// interval. An empty span gives zeros.
TimeStats time_stats(std::span<const double> samples_ns, std::uint64_t seed, int launches = 1);

// The median of each launch, for samples as in time_stats(); empty if launches have different numbers of samples. Needs
// at least one sample.
std::vector<double> launch_medians(std::span<const double> samples_ns, int launches);

struct Ratio {
  double ratio = 0.0;
  Interval ci95;
};
// Median of the paired ratios numerator[i] / denominator[i], with an interval as in time_stats(). Both spans have the
// same length.
Ratio paired_ratio(std::span<const double> numerator, std::span<const double> denominator, std::uint64_t seed,
                   int launches = 1);

// Samples in two groups with a gap between them, caused by a switch of modes during the measurement.
struct TwoModes {
  double low = 0.0, high = 0.0;  // median of each group
};
// Groups of at least a fifth of the samples each, 5 % apart and by more than one and a half times the width of the
// wider group. None for fewer than 15 samples. Of sets with one mode (normal, exponential or Cauchy) at most one in a
// hundred is reported by chance.
std::optional<TwoModes> two_modes(std::span<const double> samples_ns);

// The slowest of several frames.
struct WorstFrame {
  std::size_t index = 0;
  double ns = 0.0;  // median over the rounds, scaled
  Interval ci95;
};
// `frames_ns`: time of each frame in each round, at least one round. `mean_ns`: the median over the rounds of the mean
// of the first `mean_frames` frames. A disturbance that hits another frame in each round is part of that median but of
// no frame's own median, so the frames' medians are scaled until their mean is `mean_ns`: no worst frame is faster than
// the mean.
WorstFrame worst_frame(std::span<const std::vector<double>> frames_ns, std::size_t mean_frames, double mean_ns,
                       std::uint64_t seed, int launches = 1);

// Scales the times of single frames of one round, of which only the shares count, so that the mean of the first
// `mean_frames` is `mean_ns`, which was measured over a whole pass.
std::vector<double> scaled_to_mean(std::vector<double> frames_ns, std::size_t mean_frames, double mean_ns);

}  // namespace clusterbench::measure
