#pragma once
// An engine's job system as threads that are lent (core/shared_threads.h).

#include <algorithm>
#include <exception>
#include <functional>
#include <mutex>

#include "core/float_environment.h"
#include "core/shared_threads.h"
#include "library/assign.h"

namespace clusterbench::library {

class LentThreads final : public SharedThreads {
 public:
  explicit LentThreads(const JobSystem& jobs) : jobs_(jobs) {}

  void each(std::size_t count, const std::function<void(std::size_t i)>& work) override {
    Parts parts{work};
    jobs_.run(jobs_.user, static_cast<std::uint32_t>(count), run_part, &parts);
    if (parts.failure) std::rethrow_exception(parts.failure);
  }

 private:
  struct Parts {
    const std::function<void(std::size_t i)>& work;
    std::mutex failing{};
    std::exception_ptr failure{};
  };

  // An engine's code is not made for exceptions.
  static void run_part(void* context, std::uint32_t i) {
    Parts& parts = *static_cast<Parts*>(context);
    const NearestRoundingScope rounding;
    try {
      parts.work(i);
    } catch (...) {
      const std::lock_guard lock(parts.failing);
      if (!parts.failure) parts.failure = std::current_exception();
    }
  }

  JobSystem jobs_;
};

}  // namespace clusterbench::library
