#pragma once
// Where a series changes. Measured values vary by themselves: binary segmentation, and each split has to pass a
// permutation test of the best of all splits, so that its being the best is paid for. Counted values do not vary: every
// step is a change. docs/history.md has the rates of false alarms and of changes found. Deterministic.

#include <cstddef>
#include <span>
#include <vector>

namespace clusterbench::measure {

struct ChangePoint {
  std::size_t index;     // first value after the change
  double before, after;  // means of the stretches on both sides, up to the neighbouring change points or the ends; of
                         // counted values the one that the last change led to, and the one that differs
  double p;              // a series without changes shows such a change at most so often; 0 where values are counted
};

struct ChangeRule {
  double max_p = 0.001;       // of series without any change, at most this share is said to have one
  double min_change = 0.005;  // smallest |after / before - 1| that matters
};

// In ascending order. The promise of `max_p` holds for any noise whose values do not depend on their order; noise that
// wanders raises more alarms. A change needs two values on each side, and a series least_values().
std::vector<ChangePoint> change_points(std::span<const double> series, const ChangeRule& rule = {});

// Of fewer values too few orders are as rare as `max_p` asks for: 14 at 0.001.
std::size_t least_values(double max_p);

// Of values that are the same whenever they are counted again: wherever one differs from the last change on by
// `min_change` or more.
std::vector<ChangePoint> counted_changes(std::span<const double> series, double min_change);

}  // namespace clusterbench::measure
