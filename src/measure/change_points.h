#pragma once
// Where a series of measurements changes its mean: E-divisive means (Matteson and James 2014; MongoDB's use of it: Daly
// et al. 2020) with Student's t test in place of permutations, as in Hunter (Fleming et al. 2023). Deterministic.

#include <cstddef>
#include <span>
#include <vector>

namespace clusterbench::measure {

struct ChangePoint {
  std::size_t index;     // first value after the change
  double before, after;  // means of the stretches on both sides, up to the neighbouring change points or the ends
  double p;              // how likely such a difference is without a change; 0 where neither side varies
};

struct ChangeRule {
  double max_p = 0.001;       // Hunter's default
  double min_change = 0.005;  // smallest |after / before - 1| that matters
};

// In ascending order. A change needs two values on each side, so one is seen from its second value on. Few points and
// much noise hide a change; they do not make one. Quadratic in time: for some hundreds of values.
std::vector<ChangePoint> change_points(std::span<const double> series, const ChangeRule& rule = {});

}  // namespace clusterbench::measure
