#include "measure/side_by_side.h"

#include <algorithm>
#include <vector>

namespace clusterbench::measure {
namespace {

bool are_beside(const FrameTimes& one, const FrameTimes& other) {
  return one.launches == other.launches && one.is_cold == other.is_cold;
}

bool has_times(const FrameTimes& one) {
  return !one.rounds_ns.empty() && std::ranges::all_of(one.rounds_ns, [](double ns) { return ns > 0.0; });
}

double middle_of(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  const std::size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]);
}

// Empty where the launches have not equally many rounds.
std::vector<double> launch_medians(const FrameTimes& one) {
  const auto launches = static_cast<std::size_t>(std::max(one.launches, 1));
  if (one.rounds_ns.size() % launches != 0) return {};
  const std::size_t rounds = one.rounds_ns.size() / launches;
  std::vector<double> medians;
  for (std::size_t launch = 0; launch < launches; ++launch)
    medians.push_back(middle_of(one.rounds_ns.subspan(launch * rounds, rounds)));
  return medians;
}

}  // namespace

std::optional<Ratio> ratio_of_rounds(const FrameTimes& one, const FrameTimes& other, std::uint64_t seed) {
  if (!are_beside(one, other) || one.rounds_ns.size() != other.rounds_ns.size()) return std::nullopt;
  if (!has_times(one) || !has_times(other)) return std::nullopt;
  return paired_ratio(one.rounds_ns, other.rounds_ns, seed, one.launches);
}

std::optional<Ratio> ratio_of_launches(const FrameTimes& one, const FrameTimes& other, std::uint64_t seed) {
  if (!are_beside(one, other) || one.launches < 2 || !has_times(one) || !has_times(other)) return std::nullopt;
  const std::vector<double> own = launch_medians(one), others = launch_medians(other);
  if (own.empty() || others.empty()) return std::nullopt;
  return paired_ratio(own, others, seed, one.launches);
}

bool takes_longer(const std::optional<Ratio>& ratio) {
  return ratio && ratio->ci95.low > 1.0;
}

}  // namespace clusterbench::measure
