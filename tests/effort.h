#pragma once
// How often tests try what chance draws. Under sanitizers, which look for bad memory on every path and not for rare
// numbers, an eighth.

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace clusterbench::test {

constexpr int tries(int count) {
#ifdef CLUSTERBENCH_SANITIZED
  return std::max(1, count / 8);
#else
  return count;
#endif
}

// All of them; under sanitizers every eighth, which is enough to meet each kind of setting once.
template <class T>
std::vector<T> some(std::vector<T> all) {
#ifdef CLUSTERBENCH_SANITIZED
  std::vector<T> kept;
  for (std::size_t i = 0; i < all.size(); i += 8) kept.push_back(std::move(all[i]));
  return kept;
#else
  return all;
#endif
}

}  // namespace clusterbench::test
