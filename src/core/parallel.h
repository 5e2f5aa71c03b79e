#pragma once
// Threads for work whose result does not depend on their number.

#include <cstddef>
#include <functional>

namespace clusterbench {

// Calls work(begin, end) over disjoint ranges that cover [0, count), on at most `threads` threads (1: the caller's own,
// in order). The work of different ranges must not touch the same data.
void parallel_ranges(std::size_t count, int threads,
                     const std::function<void(std::size_t begin, std::size_t end)>& work);

}  // namespace clusterbench
