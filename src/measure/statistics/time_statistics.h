#pragma once
// Statistics of times: robust, paired, with bootstrap intervals. Pure functions; the clock is in the runner.

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace clusterbench::measure {

// Unknown without a value.
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

// One launch with fewer rounds has no interval: even from the shortest to the longest of five is one of 94 %.
inline constexpr std::size_t k_least_rounds = 6;

// `launches`: how many processes measured, each an equal share of the samples, one after the other. From three on
// (k_least_freedom in measure/statistics/time_change.h), the interval is Student's t of the launches' medians (their
// logarithms): it knows as many values as there were launches, however many rounds each had, since rounds of one launch
// share what makes launches differ. From one with k_least_rounds it is the bootstrap of the rounds, which holds within
// that process alone. All else has an unknown one. A known one always holds the median. Seeded: the same samples give
// the same interval. An empty span gives zeros.
TimeStats time_stats(std::span<const double> samples_ns, std::uint64_t seed, int launches = 1);

// Of samples as time_stats() has them, the median of each launch; empty where launches have not equally many. At least
// one sample.
std::vector<double> launch_medians(std::span<const double> samples_ns, int launches);

struct Ratio {
  double ratio = 0.0;
  Interval ci95;
};
// Median of the paired ratios numerator[i] / denominator[i], with an interval as time_stats() has. Both spans are
// equally long.
Ratio paired_ratio(std::span<const double> numerator, std::span<const double> denominator, std::uint64_t seed,
                   int launches = 1);

// Samples in two groups with a gap between them, as where something switches while they are measured.
struct TwoModes {
  double low = 0.0, high = 0.0;  // the median of each group
};
// Groups of at least a fifth of the samples each, apart by 5 % and by more than one and a half times the wider group.
// Of fewer than 15 samples nothing can be said: one sample of a hundred or fewer looks so by chance, if they have one
// mode (normal, exponential or Cauchy).
std::optional<TwoModes> two_modes(std::span<const double> samples_ns);

// The frame that takes longest of several.
struct WorstFrame {
  std::size_t index = 0;
  double ns = 0.0;  // median over the rounds, scaled
  Interval ci95;
};
// `frames_ns`: time of each frame in each round, at least one round. `mean_ns`: the median over the rounds of the mean
// of the first `mean_frames` frames. What disturbs another frame in each round is in that median and in no frame's own,
// so the frames' medians are scaled until their mean is `mean_ns`: no worst frame is faster than the mean.
WorstFrame worst_frame(std::span<const std::vector<double>> frames_ns, std::size_t mean_frames, double mean_ns,
                       std::uint64_t seed, int launches = 1);

// Of one round: times of single frames, of which only the shares count, scaled so that the first `mean_frames` of them
// are `mean_ns` in the mean, which was measured over a pass as a whole.
std::vector<double> scaled_to_mean(std::vector<double> frames_ns, std::size_t mean_frames, double mean_ns);

}  // namespace clusterbench::measure
