#pragma once
// How often tests try what chance draws. Under sanitizers, which look for bad memory on every path and not for rare
// numbers, an eighth.

#include <algorithm>

namespace clusterbench::test {

constexpr int tries(int count) {
#ifdef CLUSTERBENCH_SANITIZED
  return std::max(1, count / 8);
#else
  return count;
#endif
}

}  // namespace clusterbench::test
