#include "measure/statistics/change_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/random.h"

namespace clusterbench::measure {
namespace {

constexpr std::size_t k_min_stretch = 2;
constexpr std::uint64_t k_seed = 0x636c7573746572;

// The part of max_p for single steps; the rest is for stretches that rise and fall back. The sum does not exceed max_p.
constexpr double k_share_of_steps = 0.9;

// Number of permutations that may reach the observed statistic if p equals the level.
constexpr double k_reached_at_level = 5.0;

// values[begin, end) against all others. A step extends to the end of the series.
struct Stretch {
  std::size_t begin = 0, end = 0;
  double explained = 0.0;  // share of the total sum of squares explained by the two means, 0 to 1
};

double mean_of(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

// Cumulative sums of the differences from the mean, scaled so that the squares of the differences sum up to 1; empty if
// all values are equal.
std::vector<double> scaled_sums(std::span<const double> values) {
  const double mean = mean_of(values);
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  if (!(squares > 0.0)) return {};
  std::vector<double> sums{0.0};
  for (const double value : values) sums.push_back(sums.back() + (value - mean) / std::sqrt(squares));
  return sums;
}

Stretch best_step(std::span<const double> sums) {
  const std::size_t n = sums.size() - 1;
  Stretch best{0, n, 0.0};
  for (std::size_t i = k_min_stretch; i + k_min_stretch <= n; ++i) {
    const double explained = sums[i] * sums[i] * static_cast<double>(n) / static_cast<double>(i * (n - i));
    if (explained > best.explained) best = {i, n, explained};
  }
  return best;
}

// The best stretch within the series. Skips lengths that cannot explain more than `least`.
Stretch best_excursion(std::span<const double> sums, double least) {
  const std::size_t n = sums.size() - 1;
  const auto [low, high] = std::minmax_element(sums.begin(), sums.end());
  const double most = (*high - *low) * (*high - *low);
  Stretch best;
  for (std::size_t length = k_min_stretch; length + 2 * k_min_stretch <= n; ++length) {
    const double weight = static_cast<double>(n) / static_cast<double>(length * (n - length));
    if (weight * most < std::max(least, best.explained)) continue;
    for (std::size_t i = k_min_stretch; i + length + k_min_stretch <= n; ++i) {
      const double rise = sums[i + length] - sums[i];
      if (weight * rise * rise > best.explained) best = {i, i + length, weight * rise * rise};
    }
  }
  return best;
}

// Correlation of each residual (value minus the mean of its side) with the next one, at least 0.
double correlation_of_neighbours(std::span<const double> values, const Stretch& stretch) {
  std::array<double, 2> sums{}, counts{};
  const auto is_within = [&](std::size_t i) { return i >= stretch.begin && i < stretch.end ? 1u : 0u; };
  for (std::size_t i = 0; i < values.size(); ++i) {
    sums[is_within(i)] += values[i];
    counts[is_within(i)] += 1.0;
  }
  double products = 0.0, squares = 0.0, last = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double residual = values[i] - sums[is_within(i)] / counts[is_within(i)];
    products += residual * last;
    squares += residual * residual;
    last = residual;
  }
  return squares > 0.0 ? std::clamp(products / squares, 0.0, 0.9) : 0.0;
}

enum class Shape { step, excursion };

Stretch best_of(Shape shape, std::span<const double> sums, double least) {
  return shape == Shape::step ? best_step(sums) : best_excursion(sums, least);
}

// Ratio of the explained to the residual sum of squares. Correlated neighbours carry less information than their
// number: the mean of a first-order autoregressive series varies (1 + r) / (1 - r) times as much.
double statistic(std::span<const double> values, const Stretch& stretch) {
  constexpr double k_all = 1.0 - 1e-12;
  if (stretch.explained >= k_all) return std::numeric_limits<double>::max();
  const double r = correlation_of_neighbours(values, stretch);
  return stretch.explained / (1.0 - stretch.explained) * (1.0 - r) / (1.0 + r);
}

void shuffle(std::span<double> values, SplitMix64& random) {
  for (std::size_t i = values.size() - 1; i > 0; --i) std::swap(values[i], values[random.below(i + 1)]);
}

struct Found {
  Stretch stretch;
  double p = 1.0;
};

// p: the share of permutations of the values, the original included, whose best stretch is at least as good. Stops with
// 1 once it exceeds `level`.
Found tested(std::span<const double> values, Shape shape, double level) {
  const std::vector<double> sums = scaled_sums(values);
  if (sums.empty()) return {};
  Found found{best_of(shape, sums, 0.0)};
  // The same stretch in another order may differ by a unit roundoff.
  const double observed = statistic(values, found.stretch) * (1.0 - 1e-9);
  const double least = observed / (1.0 + observed);
  const double orders = std::ceil(k_reached_at_level / level);
  std::vector<double> order(values.begin(), values.end());
  SplitMix64 random(k_seed);
  double reached = 1.0;
  for (double i = 1.0; i < orders; ++i) {
    shuffle(order, random);
    const Stretch best = best_of(shape, scaled_sums(order), least);
    if (best.explained >= least && statistic(order, best) >= observed) ++reached;
    if (reached > level * orders) return {};
  }
  found.p = reached / orders;
  return found;
}

struct Edge {
  std::size_t index;
  double p;
};

void add_edges(std::span<const double> series, std::size_t begin, std::size_t end, double max_p,
               std::vector<Edge>& edges) {
  if (end - begin < 2 * k_min_stretch) return;
  const std::span<const double> values = series.subspan(begin, end - begin);
  Found found = tested(values, Shape::step, k_share_of_steps * max_p);
  if (found.p == 1.0) found = tested(values, Shape::excursion, (1.0 - k_share_of_steps) * max_p);
  if (found.p == 1.0) return;
  std::size_t from = begin;
  for (const std::size_t index : {begin + found.stretch.begin, begin + found.stretch.end}) {
    add_edges(series, from, index, max_p, edges);
    if (index == end) return;
    edges.push_back({index, found.p});
    from = index;
  }
  add_edges(series, from, end, max_p, edges);
}

// Each edge with the means of the stretches up to its neighbours.
std::vector<ChangePoint> described(std::span<const double> series, const std::vector<Edge>& edges) {
  std::vector<ChangePoint> points;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const std::size_t begin = i == 0 ? 0 : edges[i - 1].index, index = edges[i].index;
    const std::size_t end = i + 1 == edges.size() ? series.size() : edges[i + 1].index;
    points.push_back({index, mean_of(series.subspan(begin, index - begin)), mean_of(series.subspan(index, end - index)),
                      edges[i].p});
  }
  return points;
}

// |after / before - 1|; infinite if `before` is 0.
double size_of(double before, double after) {
  return after == before ? 0.0 : std::abs(after - before) / std::abs(before);
}

}  // namespace

std::vector<ChangePoint> change_points(std::span<const double> series, const ChangeRule& rule) {
  std::vector<Edge> edges;
  if (rule.max_p > 0.0) add_edges(series, 0, series.size(), rule.max_p, edges);
  std::vector<ChangePoint> points = described(series, edges);
  const auto smallest = [&] {
    return std::min_element(points.begin(), points.end(), [](const ChangePoint& a, const ChangePoint& b) {
      return size_of(a.before, a.after) < size_of(b.before, b.after);
    });
  };
  // Without the smallest one, the stretches of its neighbours become longer.
  for (auto least = smallest(); least != points.end() && size_of(least->before, least->after) < rule.min_change;
       least = smallest()) {
    edges.erase(edges.begin() + (least - points.begin()));
    points = described(series, edges);
  }
  return points;
}

// Of all choices of half of the values, two give the same split.
std::size_t least_values(double max_p) {
  std::size_t count = 2;
  for (double ways = 2.0; 2.0 / ways > k_share_of_steps * max_p; ++count) {
    const std::size_t half = (count + 2) / 2;
    ways *= static_cast<double>(count + 1) / static_cast<double>(half);
  }
  return std::max(count, 2 * k_min_stretch);
}

std::vector<ChangePoint> counted_changes(std::span<const double> series, double min_change) {
  std::vector<ChangePoint> points;
  for (std::size_t i = 1, level = 0; i < series.size(); ++i) {
    if (series[i] == series[level] || size_of(series[level], series[i]) < min_change) continue;
    points.push_back({i, series[level], series[i], 0.0});
    level = i;
  }
  return points;
}

}  // namespace clusterbench::measure
