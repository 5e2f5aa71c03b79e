#pragma once
// The Pareto front: cases that no other case beats.

#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "measure/statistics/time_statistics.h"

namespace clusterbench::measure {

// The costs of a case; smaller is better. NaN: unknown, counts as the worst.
struct Costs {
  static constexpr double k_unknown = std::numeric_limits<double>::quiet_NaN();

  Interval time_ns{k_unknown, k_unknown};  // interval of the time
  double bytes = k_unknown, overshade = k_unknown;
  // Used without times, for methods that make the same lists: larger is slower. 0: unknown.
  int slowness = 0;
};

// Whether the case of the first index takes longer than that of the second for certain.
using TakesLonger = std::function<bool(std::size_t, std::size_t)>;

// Indices of the cases that no other case dominates (no worse in every cost and better in one). Of equal cases all
// stay, except those known to be slower by `slowness`. Two times are equal unless one is longer for certain; for cases
// that were not measured side by side use intervals_apart().
std::vector<std::size_t> pareto_front(std::span<const Costs> cases, const TakesLonger& takes_longer);

// Longer: the intervals do not overlap.
TakesLonger intervals_apart(std::span<const Costs> cases);

}  // namespace clusterbench::measure
