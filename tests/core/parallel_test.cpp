#include "core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/shared_threads.h"

namespace clusterbench {
namespace {

class ParallelRanges : public testing::TestWithParam<int> {};

TEST_P(ParallelRanges, every_place_is_visited_once) {
  for (const std::size_t count : {0u, 1u, 2u, 1000u}) {
    std::vector<int> visits(count, 0);
    parallel_ranges(count, GetParam(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) ++visits[i];
    });
    EXPECT_EQ(visits, std::vector<int>(count, 1));
  }
}

INSTANTIATE_TEST_SUITE_P(Threads, ParallelRanges, testing::Values(1, 2, 8));

class ThreadPools : public testing::TestWithParam<int> {};

TEST_P(ThreadPools, do_all_work_once_in_each_of_many_calls) {
  ThreadPool pool(GetParam());
  for (std::size_t count = 0; count < 300; ++count) {
    std::vector<int> visits(count, 0);
    pool.each(count, [&](std::size_t i) { ++visits[i]; });
    ASSERT_EQ(visits, std::vector<int>(count, 1));
  }
}

TEST_P(ThreadPools, throw_what_work_throws_and_go_on_after_it) {
  ThreadPool pool(GetParam());
  for (int round = 0; round < 20; ++round) {
    EXPECT_THROW(pool.each(100,
                           [](std::size_t i) {
                             if (i == 57) throw std::runtime_error("the 57th");
                           }),
                 std::runtime_error);
    std::atomic<int> done = 0;
    pool.each(100, [&](std::size_t) { ++done; });
    EXPECT_EQ(done, 100);
  }
}

TEST_P(ThreadPools, take_calls_from_several_threads) {
  ThreadPool pool(GetParam());
  std::atomic<int> done = 0;
  std::vector<std::thread> callers;
  for (int caller = 0; caller < 4; ++caller)
    callers.emplace_back([&] {
      for (int round = 0; round < 50; ++round) pool.each(20, [&](std::size_t) { ++done; });
    });
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(done, 4 * 50 * 20);
}

TEST_P(ThreadPools, take_calls_from_their_own_work) {
  ThreadPool pool(GetParam());
  std::atomic<int> done = 0;
  pool.each(8, [&](std::size_t) { pool.each(5, [&](std::size_t) { ++done; }); });
  EXPECT_EQ(done, 8 * 5);
}

TEST_P(ThreadPools, move) {
  ThreadPool pool(GetParam());
  ThreadPool moved(std::move(pool));
  std::atomic<int> done = 0;
  moved.each(10, [&](std::size_t) { ++done; });
  EXPECT_EQ(done, 10);
}

INSTANTIATE_TEST_SUITE_P(Threads, ThreadPools, testing::Values(1, 2, 8));

// Work that waits for another part of itself ends only if two threads share it.
TEST(ThreadPool, has_two_threads_at_work_if_there_are_two_processors) {
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "one processor";
  ThreadPool pool(2);
  std::atomic<int> there = 0;
  pool.each(2, [&](std::size_t) {
    ++there;
    while (there < 2) std::this_thread::yield();
  });
  EXPECT_EQ(there, 2);
}

// Two threads at once: each waits for the other, but not for ever.
class Meeting {
 public:
  void wait_for_other() {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    ++here_;
    while (here_ < 2 && std::chrono::steady_clock::now() < end) std::this_thread::yield();
    if (here_ == 2) ++met_;
  }
  bool was_held() const { return met_ == 2; }

 private:
  std::atomic<int> here_ = 0, met_ = 0;
};

TEST(ThreadPool, helps_with_work_within_its_work) {
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "one processor";
  Meeting outer, inner, ranges;
  ThreadPool(2).each(2, [&](std::size_t i) {
    outer.wait_for_other();
    if (i == 0) return;
    ThreadPool(2).each(2, [&](std::size_t) { inner.wait_for_other(); });
    parallel_ranges(2, 2, [&](std::size_t, std::size_t) { ranges.wait_for_other(); });
  });
  EXPECT_TRUE(outer.was_held());
  EXPECT_TRUE(inner.was_held());
  EXPECT_TRUE(ranges.was_held());
}

// A thread that waits does nothing that is not part of what it waits for: it would wait for its own lock.
TEST_P(ThreadPools, may_be_called_with_a_lock_held) {
  ThreadPool pool(GetParam());
  std::mutex one_at_a_time;
  std::atomic<int> done = 0;
  pool.each(64, [&](std::size_t) {
    const std::lock_guard lock(one_at_a_time);
    ThreadPool(GetParam()).each(16, [&](std::size_t) {
      std::this_thread::yield();
      ++done;
    });
  });
  EXPECT_EQ(done, 64 * 16);
}

class CountedThreads final : public SharedThreads {
 public:
  void each(std::size_t count, const std::function<void(std::size_t i)>& work) override {
    ++calls;
    for (std::size_t i = 0; i < count; ++i) work(i);
  }
  int calls = 0;
};

TEST(ThreadPool, takes_lent_threads_while_they_are_lent) {
  CountedThreads lent;
  std::set<std::thread::id> ids;
  std::mutex adding;
  const auto work = [&](std::size_t) {
    const std::lock_guard lock(adding);
    ids.insert(std::this_thread::get_id());
  };
  {
    const SharedThreadsScope scope(&lent);
    ThreadPool pool(4);
    pool.each(100, work);
    EXPECT_EQ(pool.threads(), 4);
  }
  EXPECT_EQ(lent.calls, 1);
  EXPECT_EQ(ids, std::set<std::thread::id>{std::this_thread::get_id()});
  ThreadPool(4).each(100, work);
  EXPECT_EQ(lent.calls, 1);
}

}  // namespace
}  // namespace clusterbench
