#include "core/parallel.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>

namespace clusterbench {
namespace {

// More workers than processors would only make oneTBB complain on standard error.
int workers(int threads) {
  return std::min(threads, oneapi::tbb::info::default_concurrency());
}

}  // namespace

struct Crew::Arena {
  oneapi::tbb::task_arena workers;
};

Crew::Crew(int threads) : threads_(threads) {
  if (threads > 1) arena_ = std::make_unique<Arena>(Arena{oneapi::tbb::task_arena(workers(threads))});
}
Crew::~Crew() = default;
Crew::Crew(Crew&&) noexcept = default;
Crew& Crew::operator=(Crew&&) noexcept = default;

void Crew::each(std::size_t count, const std::function<void(std::size_t i)>& work) {
  if (!arena_) {
    for (std::size_t i = 0; i < count; ++i) work(i);
    return;
  }
  arena_->workers.execute([&] { oneapi::tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) { work(i); }); });
}

void parallel_ranges(std::size_t count, int threads,
                     const std::function<void(std::size_t begin, std::size_t end)>& work) {
  if (threads <= 1 || count <= 1) {
    if (count > 0) work(0, count);
    return;
  }
  oneapi::tbb::task_arena arena(workers(threads));
  arena.execute([&] {
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, count),
                              [&](const auto& range) { work(range.begin(), range.end()); });
  });
}

}  // namespace clusterbench
