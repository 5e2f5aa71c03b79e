#include "measure/statistics/time_statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/random.h"
#include "measure/statistics/time_change.h"

namespace clusterbench::measure {
namespace {

constexpr int k_resamples = 1000;

// May reorder `values`. The mean of the two middle values for an even count.
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

// `values` must not be empty.
Interval interval_of(std::span<const double> values, double median, std::uint64_t seed, int launches) {
  if (launches <= 1) return values.size() < k_least_rounds ? Interval{} : bootstrap_median(values, seed);
  std::vector<double> logs = launch_medians(values, launches);
  for (double& value : logs) value = std::log(value);
  const auto count = static_cast<double>(logs.size());
  if (count - 1.0 < k_least_freedom) return {};
  const double mean = std::accumulate(logs.begin(), logs.end(), 0.0) / count;
  double squares = 0.0;
  for (const double value : logs) squares += (value - mean) * (value - mean);
  const double width = student_quantile(0.05, count - 1.0) * std::sqrt(squares / ((count - 1.0) * count));
  return {std::min(median, std::exp(mean - width)), std::max(median, std::exp(mean + width))};
}

}  // namespace

TimeStats time_stats(std::span<const double> samples_ns, std::uint64_t seed, int launches) {
  TimeStats stats;
  if (samples_ns.empty()) return stats;
  stats.samples.assign(samples_ns.begin(), samples_ns.end());
  std::vector<double> work = stats.samples;
  stats.median = median_of(work);
  for (double& value : work) value = std::abs(value - stats.median);
  stats.mad = median_of(work);
  stats.min = *std::min_element(samples_ns.begin(), samples_ns.end());
  stats.p95 = percentile(stats.samples, 0.95);
  stats.ci95 = interval_of(samples_ns, stats.median, seed, launches);
  return stats;
}

std::vector<double> launch_medians(std::span<const double> samples_ns, int launches) {
  const auto count = static_cast<std::size_t>(std::max(launches, 1));
  if (samples_ns.size() % count != 0) return {};
  const std::size_t rounds = samples_ns.size() / count;
  std::vector<double> medians;
  for (std::size_t launch = 0; launch < count; ++launch) {
    const std::span<const double> own = samples_ns.subspan(launch * rounds, rounds);
    std::vector<double> work(own.begin(), own.end());
    medians.push_back(median_of(work));
  }
  return medians;
}

Ratio paired_ratio(std::span<const double> numerator, std::span<const double> denominator, std::uint64_t seed,
                   int launches) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < numerator.size(); ++i) ratios.push_back(numerator[i] / denominator[i]);
  if (ratios.empty()) return {};
  std::vector<double> work = ratios;
  const double median = median_of(work);
  return {median, interval_of(ratios, median, seed, launches)};
}

std::optional<TwoModes> two_modes(std::span<const double> samples_ns) {
  constexpr std::size_t k_least = 15;
  constexpr double k_apart = 1.05, k_gap = 1.5;
  if (samples_ns.size() < k_least) return std::nullopt;
  std::vector<double> sorted(samples_ns.begin(), samples_ns.end());
  std::sort(sorted.begin(), sorted.end());
  if (!(sorted.front() > 0.0)) return std::nullopt;
  const std::size_t count = sorted.size(), group = (count + 4) / 5;
  for (std::size_t split = group; split + group <= count; ++split) {
    const double widest =
        std::max(std::log(sorted[split - 1] / sorted.front()), std::log(sorted.back() / sorted[split]));
    if (std::log(sorted[split] / sorted[split - 1]) <= k_gap * widest) continue;
    std::vector<double> low(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(split));
    std::vector<double> high(sorted.begin() + static_cast<std::ptrdiff_t>(split), sorted.end());
    const TwoModes modes{median_of(low), median_of(high)};
    if (modes.high > k_apart * modes.low) return modes;
  }
  return std::nullopt;
}

WorstFrame worst_frame(std::span<const std::vector<double>> frames_ns, std::size_t mean_frames, double mean_ns,
                       std::uint64_t seed, int launches) {
  WorstFrame worst;
  double sum = 0.0;  // of the medians of the frames in the mean
  for (std::size_t frame = 0; frame < frames_ns.front().size(); ++frame) {
    std::vector<double> times;
    for (const std::vector<double>& round : frames_ns) times.push_back(round[frame]);
    const TimeStats stats = time_stats(times, seed, launches);
    if (frame < mean_frames) sum += stats.median;
    if (frame == 0 || stats.median > worst.ns) worst = {frame, stats.median, stats.ci95};
  }
  const double scale = sum > 0.0 ? mean_ns * static_cast<double>(mean_frames) / sum : 1.0;
  worst.ns *= scale;
  worst.ci95.low *= scale;
  worst.ci95.high *= scale;
  return worst;
}

std::vector<double> scaled_to_mean(std::vector<double> frames_ns, std::size_t mean_frames, double mean_ns) {
  const auto end = frames_ns.begin() + static_cast<std::ptrdiff_t>(mean_frames);
  const double mean = std::accumulate(frames_ns.begin(), end, 0.0) / static_cast<double>(mean_frames);
  for (double& ns : frames_ns) ns = mean > 0.0 ? mean_ns * ns / mean : mean_ns;
  return frames_ns;
}

}  // namespace clusterbench::measure
