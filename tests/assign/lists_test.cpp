#include "assign/contract/lists.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "assign/each_target.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/random.h"

namespace clusterbench::assign {
namespace {

using testing::on_each_target;
using Ids = std::vector<std::uint32_t>;

Ids list_of(const Lists& lists, std::uint32_t cell) {
  const auto list = lists.of(cell);
  return {list.begin(), list.end()};
}

TEST(PairBuffer, lists_of_no_pairs_are_empty_for_every_cell) {
  PairBuffer pairs;
  Lists lists;
  pairs.start(3);
  pairs.finish(lists);
  EXPECT_EQ(lists.begin, (Ids{0, 0, 0, 0}));
  EXPECT_EQ(lists.cell_count(), 3u);
  EXPECT_EQ(lists.pair_count(), 0u);
}

TEST(PairBuffer, pairs_are_listed_by_cell_in_the_order_of_lights) {
  PairBuffer pairs;
  Lists lists;
  pairs.start(4);
  pairs.add(3, 0);
  pairs.add(1, 0);
  pairs.add_row(1, 3, 2);
  pairs.add(0, 5);
  pairs.add(1, 5);
  pairs.finish(lists);
  EXPECT_EQ(lists.begin, (Ids{0, 1, 4, 5, 7}));
  EXPECT_EQ(list_of(lists, 0), (Ids{5}));
  EXPECT_EQ(list_of(lists, 1), (Ids{0, 2, 5}));
  EXPECT_EQ(list_of(lists, 2), (Ids{2}));
  EXPECT_EQ(list_of(lists, 3), (Ids{0, 2}));
}

TEST(PairBuffer, random_pairs_come_out_as_an_ordered_set_holds_them) {
  SplitMix64 random(1);
  PairBuffer pairs;
  Lists lists;
  for (int round = 0; round < 20; ++round) {
    const auto cells = static_cast<std::uint32_t>(1 + random.below(300));
    std::set<std::pair<std::uint32_t, std::uint32_t>> expected;  // (cell, light): the order of the lists
    pairs.start(cells);
    for (std::uint32_t light = 0; light < 60; ++light) {
      if (random.unit() < 0.3) {
        const auto first = static_cast<std::uint32_t>(random.below(cells));
        const auto count = static_cast<std::uint32_t>(random.below(cells - first + 1));
        pairs.add_row(first, count, light);
        for (std::uint32_t cell = first; cell < first + count; ++cell) expected.emplace(cell, light);
        continue;
      }
      for (int i = 0; i < 10; ++i) {
        const auto cell = static_cast<std::uint32_t>(random.below(cells));
        if (expected.emplace(cell, light).second) pairs.add(cell, light);
      }
    }
    pairs.finish(lists);
    std::set<std::pair<std::uint32_t, std::uint32_t>> found;
    for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell)
      for (const std::uint32_t light : lists.of(cell)) found.emplace_hint(found.end(), cell, light);
    ASSERT_EQ(lists.cell_count(), cells);
    ASSERT_EQ(lists.pair_count(), expected.size());
    ASSERT_EQ(found, expected);
  }
}

TEST(PairBuffer, a_frame_leaves_nothing_behind_for_the_next_one) {
  PairBuffer pairs;
  Lists first, again;
  pairs.start(9);
  pairs.add_row(0, 9, 1);
  pairs.finish(first);
  const std::size_t held = pairs.capacity_bytes();
  pairs.start(2);
  pairs.add(1, 0);
  pairs.finish(again);
  EXPECT_EQ(again.begin, (Ids{0, 0, 1}));
  EXPECT_EQ(again.lights, (Ids{0}));
  EXPECT_EQ(pairs.capacity_bytes(), held);
}

TEST(PairBuffer, more_pairs_than_an_offset_can_count_are_refused) {
  const MemoryLimitScope enough(std::uint64_t{1} << 40);
  PairBuffer pairs;
  Lists lists;
  pairs.start(1u << 16);
  for (std::uint32_t light = 0; light < 1u << 16; ++light) pairs.add_row(0, 1u << 16, light);
  try {
    pairs.finish(lists);
    FAIL() << "2^32 pairs were taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find("4294967296"), std::string::npos) << error.what();
  }
}

// Short lists of few lights: ascending, with equal neighbours, empty ones between, and with one pair out of order.
TEST(Lists, ascend_if_each_of_them_does) {
  SplitMix64 random(7);
  int ascending = 0;
  for (int i = 0; i < 2000; ++i) {
    Lists lists{{0}, {}};
    for (std::uint64_t cell = 0, cells = random.below(6); cell < cells; ++cell) {
      for (std::uint64_t k = random.below(4); k > 0; --k)
        lists.lights.push_back(static_cast<std::uint32_t>(random.below(5)));
      if (random.below(3) > 0) std::sort(lists.lights.begin() + lists.begin.back(), lists.lights.end());
      lists.begin.push_back(static_cast<std::uint32_t>(lists.lights.size()));
    }
    bool each = true;
    for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell)
      each = each && std::is_sorted(lists.of(cell).begin(), lists.of(cell).end());
    EXPECT_EQ(are_ascending(lists), each) << i;
    ascending += each ? 1 : 0;
    make_ascending(lists);
    EXPECT_TRUE(are_ascending(lists)) << i;
  }
  EXPECT_GT(ascending, 500);
  EXPECT_LT(ascending, 1900);
}

// Two long lists with one descent, or none, at every place of a vector and behind the last whole one.
TEST(Lists, ascend_in_whole_vectors_and_the_rest) {
  on_each_target([](const std::string& target) {
    for (std::uint32_t size = 1; size < 70; ++size)
      for (std::uint32_t wrong = 0; wrong < size; ++wrong) {  // 0: none
        Lists lists{{0, size, 2 * size}, {}};
        for (std::uint32_t i = 0; i < 2 * size; ++i) lists.lights.push_back(0xffffff00u + i % size);
        ASSERT_TRUE(are_ascending(lists)) << target;
        if (wrong > 0) std::swap(lists.lights[size + wrong - 1], lists.lights[size + wrong]);
        ASSERT_EQ(are_ascending(lists), wrong == 0) << target << ", " << wrong << " of " << size;
      }
  });
}

}  // namespace
}  // namespace clusterbench::assign
