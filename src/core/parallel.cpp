#include "core/parallel.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <future>
#include <new>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "core/shared_threads.h"

#ifdef CLUSTERBENCH_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace clusterbench {
namespace {

// Work that is handed to other threads and waited for. A thread sanitizer sees neither oneTBB's library nor this file,
// so these calls report the order: code before the work happens before it, and the work before the code after it. Parts
// of the work have no order among themselves, so the sanitizer still finds races between them.
class SharedWork {
 public:
  // Of an arena with so many threads.
  explicit SharedWork(int threads) : threads_(threads) { release(&begun_); }
  SharedWork(const SharedWork&) = delete;
  ~SharedWork() { acquire(&done_); }

  // Work within work of as many threads stays in their arena, where idle threads take part: for another arena oneTBB
  // would have none left. It is isolated: a thread that waits for it, and may hold locks, does no other work meanwhile.
  template <class All>
  void run(oneapi::tbb::task_arena& arena, const All& all) const {
    if (threads_here == threads_)
      oneapi::tbb::this_task_arena::isolate(all);
    else
      arena.execute(all);
  }

  // On any thread.
  template <class Part>
  void guarded(const Part& part) {
    const Within within(threads_);
    acquire(&begun_);
    part();
    release(&done_);
  }

 private:
  // Of the arena at whose work this thread is; 0: none.
  static thread_local int threads_here;

  struct Within {
    explicit Within(int threads) : outside(std::exchange(threads_here, threads)) {}
    Within(const Within&) = delete;
    ~Within() { threads_here = outside; }
    int outside;
  };

#ifdef CLUSTERBENCH_THREAD_SANITIZER
  static void acquire(char* at) {
    __tsan_acquire(at);
  }
  static void release(char* at) {
    __tsan_release(at);
  }
#else
  static void acquire(char*) {}
  static void release(char*) {}
#endif

  int threads_;
  char begun_ = 0, done_ = 0;
};

thread_local int SharedWork::threads_here = 0;

// How many of so many threads, with this one, the system allows now.
int allowed_threads(int wanted) {
  std::promise<void> all_tried;
  const std::shared_future<void> tried = all_tried.get_future().share();
  std::vector<std::thread> helpers;
  helpers.reserve(static_cast<std::size_t>(wanted));
  try {
    while (static_cast<int>(helpers.size()) + 1 < wanted) helpers.emplace_back([tried] { tried.wait(); });
  } catch (const std::system_error&) {
    // as many as there are by now
  }
  all_tried.set_value();
  for (std::thread& helper : helpers) helper.join();
  return static_cast<int>(helpers.size()) + 1;
}

// With more workers than processors oneTBB would print a warning on standard error, and where the system allows fewer
// (`ulimit -u`, memory) it would end the process.
int workers(int threads) {
  using oneapi::tbb::global_control;
  static const int most = allowed_threads(oneapi::tbb::info::default_concurrency());
  // Never destroyed: without it oneTBB would start more threads, at the end of the process, too.
  alignas(global_control) static std::array<std::byte, sizeof(global_control)> limit;
  static const bool is_limited = new (limit.data()) global_control(global_control::max_allowed_parallelism,
                                                                   static_cast<std::size_t>(most)) != nullptr;
  static_cast<void>(is_limited);
  return std::min(threads, most);
}

}  // namespace

struct ThreadPool::Arena {
  oneapi::tbb::task_arena workers;
};

ThreadPool::ThreadPool(int threads) : threads_(threads) {
  if (threads > 1 && shared_threads() == nullptr)
    arena_ = std::make_unique<Arena>(Arena{oneapi::tbb::task_arena(workers(threads))});
}
ThreadPool::~ThreadPool() = default;
ThreadPool::ThreadPool(ThreadPool&&) noexcept = default;
ThreadPool& ThreadPool::operator=(ThreadPool&&) noexcept = default;

void ThreadPool::each(std::size_t count, const std::function<void(std::size_t i)>& work) {
  if (shared_threads() != nullptr && threads_ > 1) return shared_threads()->each(count, work);
  if (!arena_) {
    for (std::size_t i = 0; i < count; ++i) work(i);
    return;
  }
  SharedWork shared(workers(threads_));
  shared.run(arena_->workers, [&] {
    oneapi::tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) { shared.guarded([&] { work(i); }); });
  });
}

void parallel_ranges(std::size_t count, int threads,
                     const std::function<void(std::size_t begin, std::size_t end)>& work) {
  if (threads <= 1 || count <= 1) {
    if (count > 0) work(0, count);
    return;
  }
  oneapi::tbb::task_arena arena(workers(threads));
  SharedWork shared(workers(threads));
  shared.run(arena, [&] {
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, count),
                              [&](const auto& range) { shared.guarded([&] { work(range.begin(), range.end()); }); });
  });
}

}  // namespace clusterbench
