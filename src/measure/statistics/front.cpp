#include "measure/statistics/front.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clusterbench::measure {
namespace {

double known(double cost) {
  return std::isnan(cost) ? std::numeric_limits<double>::infinity() : cost;
}

// Bytes and overshade first: they are cheap to compare, times may need a statistic.
bool dominates(std::span<const Costs> cases, std::size_t a, std::size_t b, const TakesLonger& takes_longer) {
  const double a_bytes = known(cases[a].bytes), b_bytes = known(cases[b].bytes),
               a_overshade = known(cases[a].overshade), b_overshade = known(cases[b].overshade);
  if (a_bytes > b_bytes || a_overshade > b_overshade) return false;
  const bool is_better = a_bytes < b_bytes || a_overshade < b_overshade;
  if (is_better) return !takes_longer(a, b);
  const int a_slowness = cases[a].slowness, b_slowness = cases[b].slowness;
  const bool is_known_slower = a_slowness > 0 && b_slowness > a_slowness && !takes_longer(a, b);
  return takes_longer(b, a) || is_known_slower;
}

}  // namespace

std::vector<std::size_t> pareto_front(std::span<const Costs> cases, const TakesLonger& takes_longer) {
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    bool is_beaten = false;
    for (std::size_t j = 0; j < cases.size() && !is_beaten; ++j)
      is_beaten = j != i && dominates(cases, j, i, takes_longer);
    if (!is_beaten) front.push_back(i);
  }
  return front;
}

TakesLonger intervals_apart(std::span<const Costs> cases) {
  return [cases](std::size_t a, std::size_t b) { return known(cases[a].time_ns.low) > known(cases[b].time_ns.high); };
}

}  // namespace clusterbench::measure
