#include "measure/statistics/time_change.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>

namespace clusterbench::measure {
namespace {

constexpr double k_level = 0.05;

// In double, not long double; NaN stays NaN.
namespace policies = boost::math::policies;
using Student = boost::math::students_t_distribution<
    double, policies::policy<policies::promote_double<false>, policies::domain_error<policies::ignore_error>,
                             policies::overflow_error<policies::ignore_error>>>;

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double freedom_of(const MedianTime& time) {
  return static_cast<double>(time.launches > 1 ? static_cast<std::size_t>(time.launches) : time.samples) - 1.0;
}

// The standard error of a median's logarithm, from its interval: the half-width is 1.96 errors, or Student's t quantile
// for few launches.
double log_error(const MedianTime& time) {
  const double errors = time.launches > 1 ? student_quantile(k_level, freedom_of(time)) : 1.959963984540054;
  return std::log(time.ci95.high / time.ci95.low) / (2.0 * errors);
}

// Interpolated between two values at a quarter of the sorted values.
double lower_quartile(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const double rank = 0.25 * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const double above = sorted[std::min(below + 1, sorted.size() - 1)];
  return sorted[below] + (rank - static_cast<double>(below)) * (above - sorted[below]);
}

}  // namespace

double student_two_sided(double t, double freedom) {
  return 2.0 * boost::math::cdf(boost::math::complement(Student(freedom), std::abs(t)));
}

double student_quantile(double p, double freedom) {
  return boost::math::quantile(boost::math::complement(Student(freedom), 0.5 * p));
}

double launch_log_ratio(std::span<const double> base_ns, std::span<const double> next_ns) {
  return std::log(lower_quartile(next_ns) / lower_quartile(base_ns));
}

Change change_over_launches(std::span<const double> log_ratios) {
  if (log_ratios.empty()) return {};
  std::vector<double> values(log_ratios.begin(), log_ratios.end());
  std::sort(values.begin(), values.end());
  const std::size_t cut = values.size() / 5, kept = values.size() - 2 * cut;
  Change change{mean_of(std::span(values).subspan(cut, kept)), 0.0, static_cast<double>(kept) - 1.0};
  if (values.size() < 2) return change;
  const auto all = static_cast<double>(values.size());
  const double low = values[cut], high = values[cut + kept - 1];
  for (double& value : values) value = std::clamp(value, low, high);
  const double mean = mean_of(values);
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  change.error = std::sqrt(squares / ((all - 1.0) * all)) * all / static_cast<double>(kept);
  return change;
}

Change change_of_medians(const MedianTime& base, const MedianTime& next) {
  const double freedom = std::min(freedom_of(base), freedom_of(next));
  return {std::log(next.ns / base.ns), std::hypot(log_error(base), log_error(next)), freedom};
}

double half_width(const Change& change) {
  return change.is_known() ? student_quantile(k_level, change.freedom) * change.error
                           : std::numeric_limits<double>::infinity();
}

Ratio ratio_of(const Change& change) {
  const double width = half_width(change);
  if (!change.is_known()) return {std::exp(change.log_ratio), {}};
  return {std::exp(change.log_ratio), {std::exp(change.log_ratio - width), std::exp(change.log_ratio + width)}};
}

double p_value(const Change& change) {
  if (!change.is_known() || change.log_ratio == 0.0) return 1.0;
  return change.error == 0.0 ? 0.0 : student_two_sided(change.log_ratio / change.error, change.freedom);
}

std::vector<double> holm(std::span<const double> p_values) {
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p_values[a] < p_values[b]; });
  std::vector<double> corrected(p_values.size());
  double least = 0.0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    least = std::max(least, static_cast<double>(order.size() - rank) * p_values[order[rank]]);
    corrected[order[rank]] = std::min(1.0, least);
  }
  return corrected;
}

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::faster:
      return "faster";
    case Verdict::slower:
      return "slower";
    case Verdict::same:
      return "same";
    case Verdict::inconclusive:
      break;
  }
  return "inconclusive";
}

Verdict verdict_on(const Change& change, double corrected_p, double threshold) {
  const double limit = std::log1p(threshold), width = half_width(change);
  if (corrected_p < k_level && change.log_ratio > limit) return Verdict::slower;
  if (corrected_p < k_level && change.log_ratio < -limit) return Verdict::faster;
  return std::abs(change.log_ratio) + width <= limit ? Verdict::same : Verdict::inconclusive;
}

}  // namespace clusterbench::measure
