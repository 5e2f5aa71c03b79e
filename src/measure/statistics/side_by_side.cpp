#include "measure/statistics/side_by_side.h"

#include <algorithm>
#include <vector>

namespace clusterbench::measure {
namespace {

bool are_beside(const FrameTimes& a, const FrameTimes& b) {
  return a.launches == b.launches && a.is_cold == b.is_cold;
}

bool has_times(const FrameTimes& times) {
  return !times.rounds_ns.empty() && std::ranges::all_of(times.rounds_ns, [](double ns) { return ns > 0.0; });
}

}  // namespace

std::optional<Ratio> ratio_of_rounds(const FrameTimes& numerator, const FrameTimes& denominator, std::uint64_t seed) {
  if (!are_beside(numerator, denominator) || numerator.rounds_ns.size() != denominator.rounds_ns.size())
    return std::nullopt;
  if (!has_times(numerator) || !has_times(denominator)) return std::nullopt;
  return paired_ratio(numerator.rounds_ns, denominator.rounds_ns, seed, numerator.launches);
}

std::optional<Ratio> ratio_of_launches(const FrameTimes& numerator, const FrameTimes& denominator, std::uint64_t seed) {
  if (!are_beside(numerator, denominator) || numerator.launches < 2 || !has_times(numerator) || !has_times(denominator))
    return std::nullopt;
  const std::vector<double> medians = launch_medians(numerator.rounds_ns, numerator.launches),
                            denominator_medians = launch_medians(denominator.rounds_ns, denominator.launches);
  if (medians.empty() || denominator_medians.empty()) return std::nullopt;
  return paired_ratio(medians, denominator_medians, seed, numerator.launches);
}

bool takes_longer(const std::optional<Ratio>& ratio) {
  return ratio && ratio->ci95.low > 1.0;
}

}  // namespace clusterbench::measure
