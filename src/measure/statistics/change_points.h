#pragma once
// Finds changes of a series. Measured values are noisy: binary segmentation, where each split has to pass a permutation
// test against the best split of each permutation, which corrects for the selection of the best. Counted values have no
// noise: every step is a change. docs/history.md has the rates of false alarms and of detected changes. Deterministic.

#include <cstddef>
#include <span>
#include <vector>

namespace clusterbench::measure {

struct ChangePoint {
  std::size_t index;  // first value after the change
  // `before`, `after`: means of the stretches on both sides, up to the neighbouring change points or the ends; for
  // counted values the value after the previous change, and the new one.
  double before, after;
  double p;  // probability of such a change in a series without changes, at most; 0 for counted values
};

struct ChangeRule {
  double max_p = 0.001;       // at most this share of series without a change is reported with one
  double min_change = 0.005;  // smallest |after / before - 1| that matters
};

// In ascending order. `max_p` holds for any noise whose values do not depend on their order; noise that drifts raises
// more alarms. A change needs two values on each side, and a series at least least_values().
std::vector<ChangePoint> change_points(std::span<const double> series, const ChangeRule& rule = {});

// The smallest length of a series with enough permutations for a p of `max_p`: 14 at 0.001.
std::size_t least_values(double max_p);

// For values that are the same in each count: reports every value that differs from the value at the last change by
// `min_change` or more.
std::vector<ChangePoint> counted_changes(std::span<const double> series, double min_change);

}  // namespace clusterbench::measure
