#include "core/work_in_order.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "core/turns.h"

namespace clusterbench {
namespace {

class WorkInOrder : public testing::TestWithParam<int> {};

TEST_P(WorkInOrder, is_done_once_each) {
  ThreadPool pool(GetParam());
  for (const std::size_t count : {0u, 1u, 2u, 1000u}) {
    std::vector<int> visits(count, 0);
    each_in_order(pool, count, [&](std::size_t i) { ++visits[i]; });
    EXPECT_EQ(visits, std::vector<int>(count, 1));
  }
}

TEST_P(WorkInOrder, is_done_once_each_in_ranges) {
  for (const int count : {0, 1, 7, 8, 9, 1000}) {
    std::vector<int> visits(static_cast<std::size_t>(count), 0);
    ranges_in_order(GetParam(), count, 8, [&](int begin, int end) {
      EXPECT_LE(end - begin, 8);
      for (int i = begin; i < end; ++i) ++visits[static_cast<std::size_t>(i)];
    });
    EXPECT_EQ(visits, std::vector<int>(static_cast<std::size_t>(count), 1));
  }
}

TEST_P(WorkInOrder, throws_the_first_failure_by_its_number_and_begins_nothing_more) {
  ThreadPool pool(GetParam());
  for (int round = 0; round < 50; ++round) {
    std::atomic<int> begun = 0;
    try {
      each_in_order(pool, 10'000, [&](std::size_t i) {
        ++begun;
        if (i == 3) std::this_thread::sleep_for(std::chrono::microseconds(200));  // later ones fail before it
        if (i >= 3) throw std::runtime_error(std::to_string(i));
      });
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "3");
    }
    EXPECT_LT(begun, 100);
  }
}

TEST_P(WorkInOrder, delivers_results_in_the_order_of_their_numbers_one_at_a_time) {
  ThreadPool pool(GetParam());
  std::vector<std::size_t> delivered;  // not guarded: a delivery beside another is a race
  constexpr std::size_t k_count = 500;
  InOrder in_order(k_count, [&](std::size_t i) { delivered.push_back(i); });
  each_in_order(pool, k_count, [&](std::size_t i) {
    if (i % 7 == 0) std::this_thread::sleep_for(std::chrono::microseconds(50));
    in_order.ready(i);
  });
  ASSERT_EQ(delivered.size(), k_count);
  for (std::size_t i = 0; i < k_count; ++i) EXPECT_EQ(delivered[i], i);
}

TEST_P(WorkInOrder, delivers_nothing_after_a_delivery_that_fails) {
  ThreadPool pool(GetParam());
  std::atomic<int> delivered = 0;
  InOrder in_order(100, [&](std::size_t i) {
    ++delivered;
    if (i == 20) throw std::runtime_error("no room");
  });
  EXPECT_THROW(each_in_order(pool, 100, [&](std::size_t i) { in_order.ready(i); }), std::runtime_error);
  EXPECT_EQ(delivered, 21);
}

// Shares of two thirds exclude one another; one that is larger than all is given if nobody else has one.
TEST_P(WorkInOrder, a_budget_is_not_exceeded_but_by_one_alone) {
  ThreadPool pool(GetParam());
  const std::atomic<bool> stop{false};
  Budget budget(3.0);
  std::atomic<int> inside = 0, most = 0;
  each_in_order(pool, 40, [&](std::size_t i) {
    const BudgetShare share(budget, i % 5 == 0 ? 100.0 : 2.0, stop);
    ASSERT_TRUE(share.has_it());
    most = std::max(most.load(), ++inside);
    std::this_thread::sleep_for(std::chrono::microseconds(100));
    --inside;
  });
  EXPECT_EQ(most, 1);
}

TEST(Budgets, waiting_for_one_ends_with_a_stop) {
  std::atomic<bool> stop{false};
  Budget budget(1.0);
  const BudgetShare all(budget, 1.0, stop);
  std::thread signal([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    stop = true;
  });
  EXPECT_FALSE(BudgetShare(budget, 1.0, stop).has_it());
  signal.join();
}

INSTANTIATE_TEST_SUITE_P(Threads, WorkInOrder, testing::Values(1, 2, 8));

}  // namespace
}  // namespace clusterbench
