// clusterbench_slowed: the product with assignments that take some percent longer than they do, for scripts/detection
// and the tests of comparisons. With 0 percent it is the product, laid out in memory as with 3. The linker puts this
// function before TimedWork::assign (--wrap); nothing of the product knows.

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "run/timing/repeated.h"
#include "run/timing/timed_work.h"

using clusterbench::run::thread_ns;
using clusterbench::run::TimedWork;

extern "C" {
void __real__ZN12clusterbench3run9TimedWork6assignEv(TimedWork* self);
void __wrap__ZN12clusterbench3run9TimedWork6assignEv(TimedWork* self);
}

namespace {

// CLUSTERBENCH_SLOWED_PERCENT, 3 where it is not set.
double share_to_wait() {
  const char* percent = std::getenv("CLUSTERBENCH_SLOWED_PERCENT");
  return (percent == nullptr ? 3.0 : std::atof(percent)) / 100.0;
}

// Looking at the clock takes time, too, and is part of what is waited.
double cost_of_a_look() {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 1000; ++i) {
    const double start = thread_ns();
    least = std::min(least, thread_ns() - start);
  }
  return least;
}

}  // namespace

void __wrap__ZN12clusterbench3run9TimedWork6assignEv(TimedWork* self) {
  static const double share = share_to_wait(), look = cost_of_a_look();
  static double owed = 0.0;  // may be less than nothing: what was waited too long counts for the next time
  if (share == 0.0) return __real__ZN12clusterbench3run9TimedWork6assignEv(self);
  const double start = thread_ns();
  __real__ZN12clusterbench3run9TimedWork6assignEv(self);
  const double done = thread_ns();
  double now = done;
  owed += share * (done - start - look) - 2.0 * look;
  while (now - done < owed) now = thread_ns();
  owed -= now - done;
}
