#pragma once
// Runs of cells along one axis, and the intervals between boundaries that a range of values touches.

#include <algorithm>
#include <functional>
#include <vector>

namespace clusterbench::grid {

// first .. last, both included.
struct IndexRange {
  int first = 0, last = -1;

  bool empty() const { return first > last; }
  bool holds(int index) const { return first <= index && index <= last; }
  int count() const { return empty() ? 0 : last - first + 1; }
};

// Intervals i = [boundaries[i], boundaries[i + 1]] that [lo, hi] touches. Boundaries ascend; the result is empty unless
// lo <= hi.
template <class Real>
IndexRange intervals_touched(const std::vector<float>& boundaries, Real lo, Real hi) {
  if (!(lo <= hi)) return {};
  const auto from = std::lower_bound(boundaries.begin() + 1, boundaries.end(), lo);
  const auto to = std::upper_bound(boundaries.begin(), boundaries.end() - 1, hi);
  return {static_cast<int>(from - boundaries.begin()) - 1, static_cast<int>(to - boundaries.begin()) - 1};
}

// The same for descending boundaries, such as those of rows.
template <class Real>
IndexRange descending_intervals_touched(const std::vector<float>& boundaries, Real lo, Real hi) {
  if (!(lo <= hi)) return {};
  const auto from = std::lower_bound(boundaries.begin() + 1, boundaries.end(), hi, std::greater<>());
  const auto to = std::upper_bound(boundaries.begin(), boundaries.end() - 1, lo, std::greater<>());
  return {static_cast<int>(from - boundaries.begin()) - 1, static_cast<int>(to - boundaries.begin()) - 1};
}

}  // namespace clusterbench::grid
