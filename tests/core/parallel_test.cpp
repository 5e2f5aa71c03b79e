#include "core/parallel.h"

#include <gtest/gtest.h>

#include <vector>

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

}  // namespace
}  // namespace clusterbench
