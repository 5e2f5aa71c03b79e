#pragma once
// Which cases nothing else beats.

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "measure/time_statistics.h"

namespace clusterbench::measure {

// What a case costs in each respect; smaller is better. NaN: not known, counts as the worst.
struct Costs {
  static constexpr double k_unknown = std::numeric_limits<double>::quiet_NaN();

  Interval time_ns{k_unknown, k_unknown};  // in which the time lies; two that overlap are the same time
  double bytes = k_unknown, overshade = k_unknown;
};

// Places of the cases that no other case equals or beats in every respect while beating it in one. Of equal ones all
// stay.
std::vector<std::size_t> pareto_front(std::span<const Costs> cases);

}  // namespace clusterbench::measure
