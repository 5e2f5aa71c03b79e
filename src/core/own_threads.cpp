// Threads of the standard library: parallel.h without oneTBB.

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "core/parallel.h"
#include "core/shared_threads.h"

namespace clusterbench {
namespace {

using Work = std::function<void(std::size_t i)>;

// Does this thread do a part of some pool's work? Work within it is done here, since all threads may be waiting for it.
thread_local bool is_at_work = false;

// One call of each().
struct Job {
  const Work* work = nullptr;
  std::size_t count = 0;
  std::atomic<std::size_t> next = 0;
  std::mutex failing;
  std::exception_ptr failure;  // the first one

  void start(std::size_t of, const Work& with) {
    work = &with;
    count = of;
    failure = nullptr;
    next.store(0, std::memory_order_relaxed);
  }
  void keep_failure() {
    const std::lock_guard lock(failing);
    if (!failure) failure = std::current_exception();
  }
  void take_part() {
    is_at_work = true;
    for (std::size_t i = next.fetch_add(1); i < count; i = next.fetch_add(1)) try {
        (*work)(i);
      } catch (...) {
        keep_failure();
      }
    is_at_work = false;
  }
};

int helpers_for(int threads) {
  const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return std::min(threads, processors) - 1;
}

}  // namespace

struct ThreadPool::Arena {
  explicit Arena(int helper_count) {
    helpers.reserve(static_cast<std::size_t>(helper_count));
    try {
      for (int i = 0; i < helper_count; ++i) helpers.emplace_back([this] { help(); });
    } catch (const std::system_error&) {
      // The system allows no more: those that it has started do all.
    }
  }
  ~Arena() { stop(); }

  void run(std::size_t count, const Work& work) {
    const std::lock_guard one_job_at_a_time(calling);
    job.start(count, work);
    begin_round();
    job.take_part();
    wait_for_helpers();
    if (job.failure) std::rethrow_exception(job.failure);
  }

 private:
  void begin_round() {
    {
      const std::lock_guard lock(state);
      ++round;
      busy = helpers.size();
    }
    begun.notify_all();
  }
  void wait_for_helpers() {
    std::unique_lock lock(state);
    done.wait(lock, [this] { return busy == 0; });
  }
  // False at the end.
  bool wait_for_round_after(unsigned last) {
    std::unique_lock lock(state);
    begun.wait(lock, [&] { return is_ending || round != last; });
    return !is_ending;
  }
  void help() {
    for (unsigned last = 0; wait_for_round_after(last); ++last) {
      job.take_part();
      const std::lock_guard lock(state);
      if (--busy == 0) done.notify_one();
    }
  }
  void stop() {
    {
      const std::lock_guard lock(state);
      is_ending = true;
    }
    begun.notify_all();
    for (std::thread& helper : helpers) helper.join();
  }

  std::mutex calling, state;
  std::condition_variable begun, done;
  unsigned round = 0;    // a helper takes part in each once
  std::size_t busy = 0;  // helpers that have not finished the round
  bool is_ending = false;
  Job job;
  std::vector<std::thread> helpers;
};

ThreadPool::ThreadPool(int threads) : threads_(threads) {
  if (helpers_for(threads) > 0 && !is_at_work && shared_threads() == nullptr)
    arena_ = std::make_unique<Arena>(helpers_for(threads));
}
ThreadPool::~ThreadPool() = default;
ThreadPool::ThreadPool(ThreadPool&&) noexcept = default;
ThreadPool& ThreadPool::operator=(ThreadPool&&) noexcept = default;

void ThreadPool::each(std::size_t count, const Work& work) {
  if (shared_threads() != nullptr && threads_ > 1) return shared_threads()->each(count, work);
  if (arena_ && !is_at_work) return arena_->run(count, work);
  for (std::size_t i = 0; i < count; ++i) work(i);
}

void parallel_ranges(std::size_t count, int threads,
                     const std::function<void(std::size_t begin, std::size_t end)>& work) {
  if (count == 0) return;
  const std::size_t ranges = std::min(count, threads > 1 ? 4 * static_cast<std::size_t>(threads) : std::size_t{1});
  ThreadPool(threads).each(ranges, [&](std::size_t i) { work(count * i / ranges, count * (i + 1) / ranges); });
}

}  // namespace clusterbench
