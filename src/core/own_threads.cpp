// Threads of the standard library: parallel.h without oneTBB.

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "core/shared_threads.h"

namespace clusterbench {
namespace {

using Work = std::function<void(std::size_t i)>;

int helpers_for(int threads) {
  const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return std::min(threads, processors) - 1;
}

}  // namespace

struct ThreadPool::Arena {
  // One call of each(), on the stack of its caller.
  struct Job {
    Arena& arena;
    const Work& work;
    const std::size_t count;
    const int threads;  // at most so many take part
    const Job* outer;   // the call within whose work this one is; null: none
    std::atomic<std::size_t> next = 0;
    int helping = 0;  // threads that take part beside the caller
    std::mutex failing{};
    std::exception_ptr failure{};  // the first one

    bool is_open() const { return next < count && helping + 1 < threads; }
    bool is_within(const Job& other) const {
      for (const Job* job = outer; job != nullptr; job = job->outer)
        if (job == &other) return true;
      return false;
    }
    void take_part() {
      const Job* before = std::exchange(current, this);
      for (std::size_t i = next.fetch_add(1); i < count; i = next.fetch_add(1)) try {
          work(i);
        } catch (...) {
          const std::lock_guard lock(failing);
          if (!failure) failure = std::current_exception();
        }
      current = before;
    }
  };

  // The call whose work this thread is doing; null: none. Work within it is done by the same threads.
  static thread_local const Job* current;

  explicit Arena(int helper_count) {
    helpers.reserve(static_cast<std::size_t>(helper_count));
    try {
      for (int i = 0; i < helper_count; ++i) helpers.emplace_back([this] { help(); });
    } catch (const std::system_error&) {
      // The system allows no more: those that it has started do all.
    } catch (...) {
      stop();
      throw;
    }
  }
  ~Arena() { stop(); }

  void run(std::size_t count, int threads, const Work& work) {
    Job job{*this, work, count, threads, current};
    {
      const std::lock_guard lock(mutex);
      jobs.push_back(&job);
    }
    changed.notify_all();
    job.take_part();
    std::unique_lock lock(mutex);
    std::erase(jobs, &job);
    while (job.helping > 0)
      if (!help_with(&job, lock)) changed.wait(lock);
    if (job.failure) std::rethrow_exception(job.failure);
  }

 private:
  void stop() {
    {
      const std::lock_guard lock(mutex);
      is_ending = true;
    }
    changed.notify_all();
    for (std::thread& helper : helpers) helper.join();
  }
  void help() {
    std::unique_lock lock(mutex);
    while (!is_ending)
      if (!help_with(nullptr, lock)) changed.wait(lock);
  }
  // Takes part in the newest call that threads may join; false if there is none. `outer`: only in calls within its
  // work, since its caller may hold locks that other work needs; null: in any.
  bool help_with(const Job* outer, std::unique_lock<std::mutex>& lock) {
    const auto newest = std::find_if(jobs.rbegin(), jobs.rend(), [&](const Job* job) {
      return job->is_open() && (outer == nullptr || job->is_within(*outer));
    });
    if (newest == jobs.rend()) return false;
    Job& job = **newest;
    ++job.helping;
    lock.unlock();
    job.take_part();
    lock.lock();
    --job.helping;
    changed.notify_all();
    return true;
  }

  std::mutex mutex;
  std::condition_variable changed;
  std::vector<Job*> jobs;  // that threads may join, in the order of their calls
  bool is_ending = false;
  std::vector<std::thread> helpers;
};

thread_local const ThreadPool::Arena::Job* ThreadPool::Arena::current = nullptr;

ThreadPool::ThreadPool(int threads) : threads_(threads) {
  if (helpers_for(threads) > 0 && Arena::current == nullptr && shared_threads() == nullptr)
    arena_ = std::make_unique<Arena>(helpers_for(threads));
}
ThreadPool::~ThreadPool() = default;
ThreadPool::ThreadPool(ThreadPool&&) noexcept = default;
ThreadPool& ThreadPool::operator=(ThreadPool&&) noexcept = default;

void ThreadPool::each(std::size_t count, const Work& work) {
  if (shared_threads() != nullptr && threads_ > 1) return shared_threads()->each(count, work);
  Arena* arena = Arena::current != nullptr ? &Arena::current->arena : arena_.get();
  if (arena != nullptr && threads_ > 1 && count > 1) return arena->run(count, threads_, work);
  for (std::size_t i = 0; i < count; ++i) work(i);
}

void parallel_ranges(std::size_t count, int threads,
                     const std::function<void(std::size_t begin, std::size_t end)>& work) {
  if (count == 0) return;
  const std::size_t ranges = std::min(count, threads > 1 ? 4 * static_cast<std::size_t>(threads) : std::size_t{1});
  ThreadPool(threads).each(ranges, [&](std::size_t i) { work(count * i / ranges, count * (i + 1) / ranges); });
}

}  // namespace clusterbench
