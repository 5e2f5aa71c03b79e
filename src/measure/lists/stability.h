#pragma once
// Changes of lists from one step of a finely sampled path to the next.

#include <cstdint>
#include <deque>
#include <vector>

#include "assign/contract/lists.h"

namespace clusterbench::measure {

// Changes over all steps. A change is one pair (cell, light) added or removed. A flicker is a change that undoes a
// change of the same pair at most `window` steps earlier (1: in the step before).
struct Churn {
  int steps = 0;
  std::uint64_t changes = 0, most_changes = 0;  // over all steps; maximum of one step
  std::uint64_t flickers = 0;                   // over all steps

  double mean_changes() const;  // per step; 0 without steps

  friend bool operator==(const Churn&, const Churn&) = default;
};

// (method - truth) / truth: 0 if both are equal, NaN if only the truth is 0. Negative: fewer than the truth.
double excess_ratio(std::uint64_t method, std::uint64_t truth);

class ChurnMeter {
 public:
  explicit ChurnMeter(int window) : window_(static_cast<std::size_t>(window)) {}

  // The first call is the start of the path; each later call is one step. If the number of cells differs from the step
  // before, all pairs of both steps are changes, and earlier changes cannot be undone any more.
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
  std::deque<Pairs> recent_changes_;  // changes of the last `window` steps
};

}  // namespace clusterbench::measure
