#pragma once
// Which cases nothing else beats.

#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "measure/statistics/time_statistics.h"

namespace clusterbench::measure {

// What a case costs in each respect; smaller is better. NaN: not known, counts as the worst.
struct Costs {
  static constexpr double k_unknown = std::numeric_limits<double>::quiet_NaN();

  Interval time_ns{k_unknown, k_unknown};  // in which the time lies
  double bytes = k_unknown, overshade = k_unknown;
  // Where no time is known, which of methods that make the same lists is known to be slower: the larger one. 0: nothing
  // is known.
  int slowness = 0;
};

// Whether the case of the first index is known to take longer than that of the second.
using TakesLonger = std::function<bool(std::size_t, std::size_t)>;

// Indices of the cases that no other case equals or beats in every respect while beating it in one. Of equal ones all
// stay, but for those that are known to be slower by `slowness`. Two times are the same unless one is known to be
// longer; of those that were not measured side by side that is intervals_apart().
std::vector<std::size_t> pareto_front(std::span<const Costs> cases, const TakesLonger& takes_longer);

// Intervals that do not overlap.
TakesLonger intervals_apart(std::span<const Costs> cases);

}  // namespace clusterbench::measure
