#pragma once
// Memory for light lists, from those that nobody reads any more.

#include <mutex>
#include <utility>
#include <vector>

#include "assign/contract/lists.h"

namespace clusterbench::run {

// Gives out first what came last, which is still in the caches: in turns, lists of dense scenes would be in none. For
// any number of threads.
class ListMemory {
 public:
  // Lists with any content.
  assign::Lists take() {
    const std::lock_guard lock(mutex_);
    if (unused_.empty()) return {};
    assign::Lists last = std::move(unused_.back());
    unused_.pop_back();
    return last;
  }
  void give(assign::Lists lists) {
    const std::lock_guard lock(mutex_);
    unused_.push_back(std::move(lists));
  }

 private:
  std::mutex mutex_;
  std::vector<assign::Lists> unused_;
};

}  // namespace clusterbench::run
