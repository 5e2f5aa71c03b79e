#include "measure/statistics/peaks_over_threshold.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <numeric>

#include "core/random.h"
#include "core/text.h"

namespace clusterbench::measure {
namespace {

constexpr std::array k_quantiles{0.7, 0.75, 0.8, 0.85, 0.9, 0.925, 0.95, 0.975, 0.99};
constexpr double k_never = 1e-12;  // smaller probabilities are rounded to 0
constexpr std::uint64_t k_seed = 1;
constexpr int k_draws = 99;
constexpr int k_stop_at_worse = 10;  // of k_draws: a p of k_least_fit_p
constexpr int k_stop_at_draws = 40;  // with at most one worse: 1 of 13 fits with a p of k_least_fit_p

double rounded(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.3e", value);
  return std::strtod(text.data(), nullptr);
}

double rounded_chance(double value) {
  return value < k_never ? 0.0 : rounded(std::min(value, 1.0));
}

using Counts = std::map<std::uint64_t, std::uint64_t>;  // whole number, its count

// Anderson and Darling 1952. A whole number is placed at the middle of its interval's probability.
double anderson_darling(const Counts& excesses, const GeneralisedPareto& fit) {
  double count = 0.0, sum = 0.0, before = 0.0;
  for (const auto& [value, times] : excesses) count += static_cast<double>(times);
  for (const auto& [value, times] : excesses) {
    const auto y = static_cast<double>(value);
    const double above = 0.5 * (std::exp(fit.log_survival(y - 1.0)) + std::exp(fit.log_survival(y)));
    const double survival = std::clamp(above, 1e-300, 1.0 - 1e-16);
    // Ranks before + 1 to before + times: sums over them of 2 i - 1 and of 2 (count - i) + 1.
    const auto n = static_cast<double>(times);
    const double low = n * (2.0 * before + n), high = n * (2.0 * (count - before) - n);
    sum += low * std::log1p(-survival) + high * std::log(survival);
    before += n;
  }
  return -count - sum / count;
}

Counts drawn(const GeneralisedPareto& fit, std::uint64_t count, SplitMix64& random) {
  Counts excesses;
  for (std::uint64_t i = 0; i < count; ++i) {
    const double excess = std::ceil(fit.quantile(std::log1p(-random.unit())));
    ++excesses[static_cast<std::uint64_t>(std::clamp(excess, 1.0, 1e18))];
  }
  return excesses;
}

std::vector<Excess> as_excesses(const Counts& heights) {
  std::vector<Excess> excesses;
  for (const auto& [value, times] : heights) excesses.push_back({value, times});
  return excesses;
}

std::uint64_t total(const Counts& excesses) {
  std::uint64_t count = 0;
  for (const auto& [value, times] : excesses) count += times;
  return count;
}

// Expected number of different values in a sample of the fit.
double different_values(const GeneralisedPareto& fit, std::uint64_t count) {
  constexpr int k_samples = 10;
  SplitMix64 random(k_seed);
  std::size_t different = 0;
  for (int i = 0; i < k_samples; ++i) different += drawn(fit, count, random).size();
  return static_cast<double>(different) / k_samples;
}

// A p-value by parametric bootstrap: each sample is fitted, too. It stops early once the result is clear (Besag and
// Clifford 1991). The excesses have the information of `independent` independent ones, so samples have that many, and
// the statistic, which grows with the number of samples, is scaled to it.
double p_of_fit(const Counts& excesses, const GeneralisedPareto& fit, std::uint64_t independent) {
  const double share = static_cast<double>(independent) / static_cast<double>(total(excesses));
  const double statistic = share * anderson_darling(excesses, fit);
  SplitMix64 random(k_seed);
  int worse = 0, draws = 0;
  while (draws < k_draws && worse < k_stop_at_worse && (draws < k_stop_at_draws || worse > 1)) {
    const Counts sample = drawn(fit, independent, random);
    ++draws;
    if (sample.size() >= 2 && anderson_darling(sample, ParetoFit(as_excesses(sample)).best()) >= statistic) ++worse;
  }
  return worse == k_stop_at_worse ? worse / static_cast<double>(draws) : (worse + 1.0) / (draws + 1.0);
}

// Effective number of peaks: peaks of different lengths give less information on the frames above than equally long
// ones.
double count_for_lengths(const std::vector<Peak>& peaks) {
  double sum = 0.0, squares = 0.0;
  for (const Peak& peak : peaks) {
    const auto length = static_cast<double>(peak.frames_above);
    sum += length;
    squares += length * length;
  }
  return sum * sum / squares;
}

std::string whole(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.0f", value);
  return text.data();
}

std::string repeated(std::uint64_t threshold, std::uint64_t peaks, std::uint64_t heights) {
  return std::to_string(peaks) + " peaks above " + std::to_string(threshold) + " have only " +
         number_of(heights, "different height");
}

}  // namespace

// Tries one threshold after another.
struct TailMaker {
  std::span<const PathNeeds> paths;
  Tail common;  // independent of the threshold
  std::optional<Tail> best;
  std::string refusal;

  void count_frames();
  std::vector<std::uint64_t> thresholds() const;
  std::string why_no_threshold() const;
  bool refuse(const std::string& why);          // false; the reason at the lowest threshold is kept
  bool try_threshold(std::uint64_t threshold);  // true if the fit is good
};

void TailMaker::count_frames() {
  std::map<std::uint64_t, std::uint64_t> recorded;
  for (const PathNeeds& path : paths) {
    common.has_merged_frames = common.has_merged_frames || (path.frames_per_entry > 1 && path.needs.size() > 1);
    common.frames += path.frames_per_entry * path.needs.size();
    for (const std::uint64_t need : path.needs) recorded[need] += path.frames_per_entry;
  }
  common.recorded_.assign(recorded.begin(), recorded.end());
  if (recorded.empty()) return;
  common.highest = recorded.rbegin()->first;
  common.unit = 0;
  for (const auto& [need, frames] : recorded) common.unit = std::gcd(common.unit, need - recorded.begin()->first);
}

std::vector<std::uint64_t> TailMaker::thresholds() const {
  std::vector<std::uint64_t> out;
  for (const double quantile : k_quantiles) {
    double up_to = 0.0;
    for (const auto& [need, frames] : common.recorded_) {
      up_to += static_cast<double>(frames);
      if (up_to < quantile * static_cast<double>(common.frames)) continue;
      if (need < common.highest && (out.empty() || out.back() != need)) out.push_back(need);
      break;
    }
  }
  return out;
}

std::string TailMaker::why_no_threshold() const {
  if (common.frames >= 2 * k_least_peaks) return "30 % of the frames or more are at the maximum";
  return "only " + number_of(common.frames, "frame") + " recorded";
}

bool TailMaker::refuse(const std::string& why) {
  if (refusal.empty()) refusal = why;
  return false;
}

bool TailMaker::try_threshold(std::uint64_t threshold) {
  const Clusters clusters = clusters_above(paths, threshold);
  const std::uint64_t peaks = clusters.peaks.size(), cut = std::ranges::count_if(clusters.peaks, &Peak::is_cut);
  if (peaks - cut < k_least_peaks)
    return refuse(std::to_string(peaks - cut) + " of the " + std::to_string(k_least_peaks) +
                  " independent peaks it needs" +
                  (cut > 0 ? " (and " + std::to_string(cut) + " cut off at an end of the path)" : "") +
                  "; record more frames or run worst-case");
  // Uses steps wider than the unit for a wide range: the likelihood only needs the interval of an excess.
  constexpr std::uint64_t k_most_steps = 250;
  const std::uint64_t range = (common.highest - threshold) / common.unit;
  const std::uint64_t step = common.unit * ((range + k_most_steps - 1) / k_most_steps);
  const auto steps_above = [&](std::uint64_t need) { return (need - threshold + step - 1) / step; };
  Counts excesses, heights;
  for (const auto& [need, frames] : common.recorded_)
    if (need > threshold) excesses[steps_above(need)] += frames;
  for (const Peak& peak : clusters.peaks) ++heights[steps_above(peak.height)];
  if (excesses.size() < 2) return refuse(repeated(threshold, peaks, 1));
  const ParetoFit fit(as_excesses(excesses));
  const double expected = different_values(fit.best(), peaks);
  if (static_cast<double>(heights.size()) < 0.8 * expected - 2.0)
    return refuse(repeated(threshold, peaks, heights.size()) + " where " + whole(expected) +
                  " were to be expected: the paths repeat themselves or reach a limit");
  const double p = rounded(p_of_fit(excesses, fit.best(), peaks));
  // Below that, the likelihood interval is not valid (Smith 1985): the fitted end is at the largest peak.
  constexpr double k_least_regular_shape = -0.5;
  const double shape = rounded(fit.best().shape());
  const bool fits = p >= k_least_fit_p && shape >= k_least_regular_shape;
  if (best && !fits && !(p > best->fit_p)) return false;
  Tail tail = common;
  tail.threshold = threshold;
  tail.peaks = peaks;
  tail.cut_peaks = cut;
  tail.frames_above = total(excesses);
  tail.extremal_index = rounded(clusters.extremal_index);
  tail.shape = shape;
  tail.scale = rounded(fit.best().scale() * static_cast<double>(step));
  if (fit.best().bend < 0.0)
    tail.end = rounded(static_cast<double>(threshold) - static_cast<double>(step) / fit.best().bend);
  tail.fit_p = p;
  tail.fits = fits;
  tail.step_ = step;
  tail.counted_peaks_ = count_for_lengths(clusters.peaks);
  tail.fit_ = fit;
  best = std::move(tail);
  return best->fits;
}

// In steps of the fit; a need between two units is rounded down.
double Tail::excess_of(std::uint64_t capacity) const {
  if (capacity < threshold) return 0.0;
  const std::uint64_t units = (capacity - threshold) / unit * unit;
  return static_cast<double>(units) / static_cast<double>(step_);
}

// Share of frames above the capacity, or above the threshold if that is lower.
double Tail::share_above(std::uint64_t capacity) const {
  std::uint64_t above = 0;
  for (const auto& [need, needed_by] : recorded_)
    if (need > std::min(capacity, threshold)) above += needed_by;
  return static_cast<double>(above) / static_cast<double>(frames);
}

double Tail::estimate_above(std::uint64_t capacity) const {
  return share_above(capacity) * std::exp(fit_->best().log_survival(excess_of(capacity)));
}

Chance Tail::chance_above(std::uint64_t capacity) const {
  const double share = share_above(capacity);
  const ParetoFit::LogRange range = fit_->log_survival_range(excess_of(capacity), counted_peaks_, counted_peaks_);
  return {rounded_chance(estimate_above(capacity)),
          {rounded_chance(share * std::exp(range.low)), rounded_chance(share * std::exp(range.high))}};
}

Tail::Capacity Tail::capacity_for(double chance_per_frame) const {
  const auto least = [&](auto is_enough) -> std::optional<std::uint64_t> {
    std::uint64_t low = 0, high = std::max<std::uint64_t>(highest, 1);
    while (!is_enough(high)) {
      if (high > std::numeric_limits<std::uint64_t>::max() / 2) return std::nullopt;
      low = high + 1;
      high *= 2;
    }
    while (low < high) {
      const std::uint64_t middle = low + (high - low) / 2;
      if (is_enough(middle))
        high = middle;
      else
        low = middle + 1;
    }
    return high;
  };
  const auto estimate = least([&](std::uint64_t capacity) { return estimate_above(capacity) <= chance_per_frame; });
  return {estimate.value_or(std::numeric_limits<std::uint64_t>::max()),
          least([&](std::uint64_t capacity) { return chance_above(capacity).ci95.high <= chance_per_frame; })};
}

TailEstimate tail_of(std::span<const PathNeeds> paths) {
  TailMaker maker{.paths = paths, .common = {}, .best = {}, .refusal = {}};
  maker.count_frames();
  if (maker.common.frames == 0) return {{}, "no frames were recorded"};
  if (maker.common.unit == 0) return {{}, "every frame needs " + std::to_string(maker.common.highest)};
  const std::vector<std::uint64_t> thresholds = maker.thresholds();
  if (thresholds.empty()) return {{}, maker.why_no_threshold()};
  for (const std::uint64_t threshold : thresholds)
    if (maker.try_threshold(threshold)) break;
  if (!maker.best) return {{}, maker.refusal};
  return {std::move(maker.best), ""};
}

}  // namespace clusterbench::measure
