#pragma once
// An engine's job system as threads that are lent (core/shared_threads.h).

#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "core/error.h"
#include "core/float_environment.h"
#include "core/shared_threads.h"
#include "library/assign.h"

namespace clusterbench::library {

class LentThreads final : public SharedThreads {
 public:
  explicit LentThreads(const JobSystem& jobs) : jobs_(jobs) {}

  void each(std::size_t count, const std::function<void(std::size_t i)>& work) override {
    make_room(count);
    Parts parts{work, count, begun_.get()};
    jobs_.run(jobs_.user, static_cast<std::uint32_t>(count), run_part, &parts);
    if (parts.failure) std::rethrow_exception(parts.failure);
    check(parts);
  }

 private:
  struct Parts {
    const std::function<void(std::size_t i)>& work;
    std::size_t count;
    std::atomic<bool>* begun;
    std::atomic<std::size_t> done = 0;
    std::atomic<bool> has_strange = false;  // a part that is none, or that was called before
    std::mutex failing{};
    std::exception_ptr failure{};
  };

  // Kept from frame to frame: a steady frame allocates nothing.
  void make_room(std::size_t count) {
    if (count > room_) begun_ = std::make_unique<std::atomic<bool>[]>(count);
    room_ = count > room_ ? count : room_;
    for (std::size_t i = 0; i < count; ++i) begun_[i] = false;
  }

  // Lists without a part, or with two threads in one, would be wrong without a sign.
  static void check(const Parts& parts) {
    if (parts.done == parts.count && !parts.has_strange) return;
    throw Error("", "jobs.run",
                "returned after " + std::to_string(parts.done) + " of " + std::to_string(parts.count) + " parts" +
                    (parts.has_strange ? ", and called one twice or one that is none" : "") +
                    "; allowed: to call each part once and to return after all of them");
  }

  // An engine's code is not made for exceptions.
  static void run_part(void* context, std::uint32_t i) {
    Parts& parts = *static_cast<Parts*>(context);
    if (i >= parts.count || parts.begun[i].exchange(true)) {
      parts.has_strange = true;
      return;
    }
    const NearestRoundingScope rounding;
    try {
      parts.work(i);
    } catch (...) {
      const std::lock_guard lock(parts.failing);
      if (!parts.failure) parts.failure = std::current_exception();
    }
    ++parts.done;
  }

  JobSystem jobs_;
  std::unique_ptr<std::atomic<bool>[]> begun_;
  std::size_t room_ = 0;
};

}  // namespace clusterbench::library
