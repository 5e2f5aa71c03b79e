#include "measure/timing.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/random.h"

namespace clusterbench::measure {
namespace {

constexpr int k_resamples = 1000;

// Of a range that it may reorder; the mean of the two middle values for an even count.
double median_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

double percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[std::clamp<std::size_t>(rank, 1, values.size()) - 1];
}

// Percentile bootstrap of the median (Efron 1979).
Interval bootstrap_median(std::span<const double> values, std::uint64_t seed) {
  SplitMix64 random(seed);
  std::vector<double> medians, resample(values.size());
  for (int i = 0; i < k_resamples; ++i) {
    for (double& value : resample) value = values[random.below(values.size())];
    medians.push_back(median_of(resample));
  }
  return {percentile(medians, 0.025), percentile(medians, 0.975)};
}

}  // namespace

TimeStats time_stats(std::span<const double> samples_ns, std::uint64_t seed) {
  TimeStats stats;
  if (samples_ns.empty()) return stats;
  stats.samples.assign(samples_ns.begin(), samples_ns.end());
  std::vector<double> work = stats.samples;
  stats.median = median_of(work);
  for (double& value : work) value = std::abs(value - stats.median);
  stats.mad = median_of(work);
  stats.min = *std::min_element(samples_ns.begin(), samples_ns.end());
  stats.p95 = percentile(stats.samples, 0.95);
  stats.ci95 = bootstrap_median(samples_ns, seed);
  return stats;
}

Ratio paired_ratio(std::span<const double> numerator, std::span<const double> denominator, std::uint64_t seed) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < numerator.size(); ++i) ratios.push_back(numerator[i] / denominator[i]);
  if (ratios.empty()) return {};
  const Interval interval = bootstrap_median(ratios, seed);
  return {median_of(ratios), interval};
}

WorstFrame worst_frame(std::span<const std::vector<double>> frames_ns, std::span<const double> pass_ns,
                       std::uint64_t seed) {
  const std::size_t count = frames_ns.front().size();
  WorstFrame worst;
  for (std::size_t frame = 0; frame < count; ++frame) {
    std::vector<double> times;
    for (std::size_t round = 0; round < frames_ns.size(); ++round) {
      const std::vector<double>& all = frames_ns[round];
      const double mean = std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(count);
      times.push_back(mean > 0.0 ? pass_ns[round] * all[frame] / mean : pass_ns[round]);
    }
    const TimeStats stats = time_stats(times, seed);
    if (frame == 0 || stats.median > worst.ns) worst = {frame, stats.median, stats.ci95};
  }
  return worst;
}

}  // namespace clusterbench::measure
