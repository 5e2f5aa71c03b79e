#pragma once
// Work on several threads whose parts begin in order, and whose failure does not depend on the number of threads.

#include <cstddef>
#include <functional>

#include "core/parallel.h"

namespace clusterbench {

// The number of processors that this process may use, at least 1.
int processors();

// Calls work(i) for 0 <= i < count, each once, on any thread of the pool; work(i) begins after work(i - 1) has begun.
// If parts throw, no further part begins, and this throws what the first of them, by its number, has thrown.
void each_in_order(ThreadPool& pool, std::size_t count, const std::function<void(std::size_t i)>& work);

// The same over ranges of [0, count), each but the last of `at_once`: calls work(begin, end).
void ranges_in_order(int threads, int count, int at_once, const std::function<void(int begin, int end)>& work);

// Whether part i of such work should use all threads itself: it is among the last ones, beside which threads are idle.
inline bool is_near_end(std::size_t i, std::size_t count, const ThreadPool& pool) {
  constexpr std::size_t k_last_of_thread = 4;
  return i + k_last_of_thread * static_cast<std::size_t>(pool.threads()) >= count;
}

}  // namespace clusterbench
