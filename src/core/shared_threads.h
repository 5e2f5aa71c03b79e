#pragma once
// Threads that somebody else lends for a while: an engine's job system in place of a pool's own threads.

#include <cstddef>
#include <functional>

namespace clusterbench {

class SharedThreads {
 public:
  virtual ~SharedThreads() = default;
  // Calls work(i) for 0 <= i < count, each once, on any thread, and returns after all of them. `work` throws nothing.
  virtual void each(std::size_t count, const std::function<void(std::size_t i)>& work) = 0;
};

// Lent to this thread now; null: none. Pools that are made, and used, while threads are lent take these.
SharedThreads* shared_threads();

class SharedThreadsScope {
 public:
  explicit SharedThreadsScope(SharedThreads* threads);  // null: none
  ~SharedThreadsScope();
  SharedThreadsScope(const SharedThreadsScope&) = delete;
  SharedThreadsScope& operator=(const SharedThreadsScope&) = delete;

 private:
  SharedThreads* before_;
};

}  // namespace clusterbench
