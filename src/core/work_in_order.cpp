#include "core/work_in_order.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

namespace clusterbench {
namespace {

// The failure with the smallest number: all parts before it have begun, and each of them ends.
class FirstFailure {
 public:
  void add(std::size_t part) {
    const std::lock_guard lock(mutex_);
    if (part >= part_) return;
    part_ = part;
    failure_ = std::current_exception();
    has_failed = true;
  }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

  std::atomic<bool> has_failed{false};

 private:
  std::mutex mutex_;
  std::size_t part_ = static_cast<std::size_t>(-1);
  std::exception_ptr failure_;
};

}  // namespace

int processors() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void each_in_order(ThreadPool& pool, std::size_t count, const std::function<void(std::size_t i)>& work) {
  std::atomic<std::size_t> next = 0;
  FirstFailure failure;
  const auto take_part = [&](std::size_t) {
    while (!failure.has_failed) {
      const std::size_t i = next.fetch_add(1);
      if (i >= count) return;
      try {
        work(i);
      } catch (...) {
        failure.add(i);
      }
    }
  };
  pool.each(std::min(count, static_cast<std::size_t>(std::max(1, pool.threads()))), take_part);
  failure.rethrow();
}

void ranges_in_order(int threads, int count, int at_once, const std::function<void(int begin, int end)>& work) {
  ThreadPool pool(threads);
  each_in_order(pool, static_cast<std::size_t>((count + at_once - 1) / at_once), [&](std::size_t i) {
    const int begin = static_cast<int>(i) * at_once;
    work(begin, std::min(count, begin + at_once));
  });
}

}  // namespace clusterbench
