#pragma once
// What threads that share work need beside it: results in the order of their numbers, and a shared budget.

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <vector>

#include "core/stop.h"

namespace clusterbench {

// Delivers numbered results in their order, one at a time, on whichever thread has the next one.
class InOrder {
 public:
  InOrder(std::size_t count, std::function<void(std::size_t i)> deliver)
      : is_ready_(count, false), deliver_(std::move(deliver)) {}

  // Result i is ready, once. Delivers it and all that are ready behind it, unless an earlier one is missing or another
  // thread is delivering. After a delivery that throws there is none.
  void ready(std::size_t i);

 private:
  std::mutex mutex_;
  std::vector<bool> is_ready_;
  std::function<void(std::size_t i)> deliver_;
  std::size_t next_ = 0;
  bool is_delivering_ = false;
};

// A limit on what several threads use together, in any unit.
class Budget {
 public:
  explicit Budget(double all) : all_(all) {}

  // Waits until there is room for the share, or nobody else has one. False if stopped meanwhile.
  bool take(double share, const Stop& stop);
  void give_back(double share);

 private:
  double all_, used_ = 0.0;
  std::size_t users_ = 0;
  std::mutex mutex_;
  std::condition_variable freed_;
};

// A share of a budget as long as it lives.
class BudgetShare {
 public:
  BudgetShare(Budget& budget, double share, const Stop& stop)
      : budget_(budget), share_(share), has_it_(budget.take(share, stop)) {}
  ~BudgetShare() {
    if (has_it_) budget_.give_back(share_);
  }
  BudgetShare(const BudgetShare&) = delete;
  BudgetShare& operator=(const BudgetShare&) = delete;

  // Without it the work was stopped.
  bool has_it() const { return has_it_; }

 private:
  Budget& budget_;
  double share_;
  bool has_it_;
};

}  // namespace clusterbench
