#pragma once
// How lists change from one step of a finely sampled path to the next.

#include <cstdint>
#include <deque>
#include <vector>

#include "assign/contract/lists.h"

namespace clusterbench::measure {

// What changed over all steps. A change is one pair (cell, light) added or removed. A flicker is a change back: one
// that undoes the same pair's change at most `window` steps earlier (1: in the step right before).
struct Churn {
  int steps = 0;
  std::uint64_t changes = 0, most_changes = 0;  // over all steps; in the step with most
  std::uint64_t flickers = 0;                   // over all steps

  double mean_changes() const;  // per step; 0 without a step

  friend bool operator==(const Churn&, const Churn&) = default;
};

// (method - truth) / truth: 0 when both are equal, NaN when only the truth is 0. Negative: fewer than the truth.
double excess_ratio(std::uint64_t method, std::uint64_t truth);

class ChurnMeter {
 public:
  explicit ChurnMeter(int window) : window_(static_cast<std::size_t>(window)) {}

  // The first lists are where the path begins; each later call is one step. Where a grid has more or fewer cells than
  // in the step before, all pairs of both are changes, and no earlier one can be changed back.
  void add(const assign::Lists& lists);
  const Churn& result() const { return churn_; }

 private:
  using Pairs = std::vector<std::uint64_t>;  // cell in the upper half, light in the lower; ascending

  void add_new_grid(const assign::Lists& lists);
  Pairs changed_from_last(const assign::Lists& lists) const;
  bool has_changed_lately(std::uint64_t pair) const;

  std::size_t window_;
  Churn churn_;
  bool has_begun_ = false;
  assign::Lists last_;
  std::deque<Pairs> lately_;  // what the last `window` steps changed
};

}  // namespace clusterbench::measure
