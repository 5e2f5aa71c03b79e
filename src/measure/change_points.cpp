#include "measure/change_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "measure/change.h"

namespace clusterbench::measure {
namespace {

constexpr std::size_t k_min_stretch = 2;

// A split that is not convincing alone can be so once its neighbours are known, so splits are looked for with a larger
// p and weeded out afterwards (Hunter).
constexpr double k_search_p_factor = 10.0;

struct Mean {
  double mean = 0.0, squares = 0.0;  // sum of squared distances from the mean
  std::size_t count = 0;
};

Mean mean_of(std::span<const double> values) {
  Mean out{0.0, 0.0, values.size()};
  for (const double value : values) out.mean += value;
  out.mean /= static_cast<double>(values.size());
  for (const double value : values) out.squares += (value - out.mean) * (value - out.mean);
  return out;
}

// Two-sided, equal variances.
double p_of(const Mean& a, const Mean& b) {
  const double difference = std::abs(a.mean - b.mean);
  if (difference == 0.0) return 1.0;
  const double freedom = static_cast<double>(a.count + b.count) - 2.0;
  const double variance = (a.squares + b.squares) / freedom;
  const double error = std::sqrt(variance * (1.0 / static_cast<double>(a.count) + 1.0 / static_cast<double>(b.count)));
  return error == 0.0 ? 0.0 : student_two_sided(difference / error, freedom);
}

double pairs_within(std::size_t count) {
  return static_cast<double>(count) * static_cast<double>(count - 1) / 2.0;
}

// The energy distance between values[0, split) and the rest, scaled by their numbers (Matteson and James, equation 7
// with exponent 1), for every split; the sums of distances move with the split.
std::size_t best_split(std::span<const double> values, double& best) {
  const std::size_t n = values.size();
  double left = 0.0, right = 0.0, between = 0.0;  // sums of |difference| of pairs
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) right += std::abs(values[i] - values[j]);
  std::size_t place = 0;
  best = -std::numeric_limits<double>::infinity();
  for (std::size_t split = 1; split + k_min_stretch <= n; ++split) {
    const double moved = values[split - 1];
    double to_left = 0.0, to_right = 0.0;
    for (std::size_t i = 0; i + 1 < split; ++i) to_left += std::abs(values[i] - moved);
    for (std::size_t i = split; i < n; ++i) to_right += std::abs(values[i] - moved);
    left += to_left;
    right -= to_right;
    between += to_right - to_left;
    if (split < k_min_stretch) continue;
    const auto l = static_cast<double>(split), r = static_cast<double>(n - split);
    const double distance = 2.0 * between / (l * r) - left / pairs_within(split) - right / pairs_within(n - split);
    const double weighted = l * r / (l + r) * distance;
    if (weighted > best) {
      best = weighted;
      place = split;
    }
  }
  return place;
}

void split(std::span<const double> series, std::size_t begin, std::size_t end, double max_p,
           std::vector<std::size_t>& places) {
  if (end - begin < 2 * k_min_stretch) return;
  double distance = 0.0;
  const std::size_t place = begin + best_split(series.subspan(begin, end - begin), distance);
  if (distance <= 0.0) return;
  const double p = p_of(mean_of(series.subspan(begin, place - begin)), mean_of(series.subspan(place, end - place)));
  if (p > max_p) return;
  split(series, begin, place, max_p, places);
  places.push_back(place);
  split(series, place, end, max_p, places);
}

// Each place with the stretches up to its neighbours.
std::vector<ChangePoint> described(std::span<const double> series, const std::vector<std::size_t>& places) {
  std::vector<ChangePoint> points;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::size_t begin = i == 0 ? 0 : places[i - 1], end = i + 1 == places.size() ? series.size() : places[i + 1];
    const Mean before = mean_of(series.subspan(begin, places[i] - begin));
    const Mean after = mean_of(series.subspan(places[i], end - places[i]));
    points.push_back({places[i], before.mean, after.mean, p_of(before, after)});
  }
  return points;
}

bool is_too_small(const ChangePoint& point, double min_change) {
  return std::abs(point.after - point.before) < min_change * std::abs(point.before);
}

// The point to give up: the least convincing of those that do not hold; points.size() if all do.
std::size_t weakest(const std::vector<ChangePoint>& points, const ChangeRule& rule) {
  std::size_t place = points.size();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].p <= rule.max_p && !is_too_small(points[i], rule.min_change)) continue;
    if (place == points.size() || points[i].p > points[place].p) place = i;
  }
  return place;
}

}  // namespace

std::vector<ChangePoint> change_points(std::span<const double> series, const ChangeRule& rule) {
  std::vector<std::size_t> places;
  split(series, 0, series.size(), std::min(k_search_p_factor * rule.max_p, 1.0), places);
  std::vector<ChangePoint> points = described(series, places);
  for (std::size_t gone = weakest(points, rule); gone < points.size(); gone = weakest(points, rule)) {
    places.erase(places.begin() + static_cast<std::ptrdiff_t>(gone));
    points = described(series, places);
  }
  return points;
}

}  // namespace clusterbench::measure
