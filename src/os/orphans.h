#pragma once
// Processes whose parents have ended, as those that foreign code leaves behind.

#include <vector>

namespace clusterbench::os {

class Orphans {
 public:
  // From here on those of processes that this one starts become this process's. Its children so far are others'.
  Orphans();

  // Ends all that there are, once this process has waited for its own. Returns how many did not end by
  // themselves within 200 ms.
  int end_all() const;

 private:
  std::vector<int> others_;
};

// Processes that this one has started, or taken over, and that have not been waited for.
std::vector<int> child_processes();
// Of this process.
int thread_count();
// Those of them that run or wait for a processor, without the caller's; 0 where the system does not tell.
int runnable_threads();

}  // namespace clusterbench::os
