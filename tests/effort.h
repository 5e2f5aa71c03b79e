#pragma once
// How often tests try what chance draws. Under sanitizers, which look for bad memory on every path and not for rare
// numbers, an eighth.

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace clusterbench::test {

#ifdef CLUSTERBENCH_SANITIZED
inline constexpr bool k_sanitized = true;
#else
inline constexpr bool k_sanitized = false;
#endif

constexpr int tries(int count) {
  return k_sanitized ? std::max(1, count / 8) : count;
}

// All of them; under sanitizers every eighth (or `nth`, from a first one on), which is enough to meet each kind of
// setting once.
template <class T>
std::vector<T> every_nth(std::vector<T> all, std::size_t nth, std::size_t first) {
  std::vector<T> kept;
  for (std::size_t i = first; i < all.size(); i += nth) kept.push_back(std::move(all[i]));
  return kept;
}
template <class T>
std::vector<T> some(std::vector<T> all, std::size_t nth = 8, std::size_t first = 0) {
  if constexpr (!k_sanitized) return all;
  return every_nth(std::move(all), nth, first);
}

}  // namespace clusterbench::test
