#include "measure/front.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clusterbench::measure {
namespace {

double known(double cost) {
  return std::isnan(cost) ? std::numeric_limits<double>::infinity() : cost;
}

bool dominates(const Costs& a, const Costs& b) {
  if (known(a.time_ns.low) > known(b.time_ns.high) || known(a.bytes) > known(b.bytes) ||
      known(a.overshade) > known(b.overshade))
    return false;
  return known(a.time_ns.high) < known(b.time_ns.low) || known(a.bytes) < known(b.bytes) ||
         known(a.overshade) < known(b.overshade);
}

}  // namespace

std::vector<std::size_t> pareto_front(std::span<const Costs> cases) {
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const bool is_beaten =
        std::any_of(cases.begin(), cases.end(), [&](const Costs& other) { return dominates(other, cases[i]); });
    if (!is_beaten) front.push_back(i);
  }
  return front;
}

}  // namespace clusterbench::measure
