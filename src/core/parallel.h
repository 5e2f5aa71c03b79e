#pragma once
// Threads for work whose result does not depend on their number.

#include <cstddef>
#include <functional>
#include <memory>

namespace clusterbench {

// Calls work(begin, end) over disjoint ranges that cover [0, count), on at most `threads` threads (1: the caller's own,
// in order). The work of different ranges must not touch the same data. What work throws, this throws.
void parallel_ranges(std::size_t count, int threads,
                     const std::function<void(std::size_t begin, std::size_t end)>& work);

// Persistent threads for short work that is repeated often. Pools may be used within the work of others, with locks
// held, too; the threads are then those of the outermost pool, at most as many as both have. With oneTBB a thread that
// waits for an outermost call may meanwhile do work of another thread's call: do not hold a lock there that such work
// needs. parallel.cpp makes them of oneTBB, for the program; own_threads.cpp of std::thread, for the library, which
// needs no other one.
class ThreadPool {
 public:
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(ThreadPool&&) noexcept;
  ThreadPool& operator=(ThreadPool&&) noexcept;

  int threads() const { return threads_; }
  // Calls work(i) for 0 <= i < count, each once, on any thread, and returns after all of them. What work throws, this
  // throws.
  void each(std::size_t count, const std::function<void(std::size_t i)>& work);

 private:
  struct Arena;
  int threads_;
  std::unique_ptr<Arena> arena_;  // none for one thread
};

}  // namespace clusterbench
