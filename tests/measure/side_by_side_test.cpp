#include "measure/statistics/side_by_side.h"

#include <gtest/gtest.h>

namespace clusterbench::measure {
namespace {

const std::vector<double> k_first{100, 102, 200, 202, 150, 152};   // three launches of two rounds
const std::vector<double> k_second{111, 112, 219, 222, 165, 168};  // 1.1 times as long
const std::vector<double> k_more{111, 112, 110, 219, 222, 220, 165, 168, 166};

FrameTimes times(const std::vector<double>& rounds_ns, int launches = 3, bool is_cold = false) {
  return {rounds_ns, launches, is_cold};
}

TEST(SideBySide, a_ratio_of_the_same_rounds_is_steadier_than_the_times) {
  const auto ratio = ratio_of_rounds(times(k_second), times(k_first), 1);
  ASSERT_TRUE(ratio);
  EXPECT_NEAR(ratio->ratio, 1.1, 0.01);
  EXPECT_GT(ratio->ci95.low, 1.08);
  EXPECT_LT(ratio->ci95.high, 1.12);
  EXPECT_TRUE(takes_longer(ratio));
  EXPECT_FALSE(takes_longer(ratio_of_rounds(times(k_first), times(k_second), 1)));
  EXPECT_FALSE(takes_longer(std::nullopt));
}

TEST(SideBySide, of_the_same_launches_it_takes_no_common_rounds) {
  EXPECT_FALSE(ratio_of_rounds(times(k_more), times(k_first), 1));
  const auto ratio = ratio_of_launches(times(k_more), times(k_first), 1);
  ASSERT_TRUE(ratio);
  EXPECT_NEAR(ratio->ratio, 1.1, 0.01);
  EXPECT_TRUE(takes_longer(ratio));
  EXPECT_FALSE(ratio_of_launches(times(k_more, 1), times(k_first, 1), 1)) << "one launch says nothing of the next";
  EXPECT_FALSE(ratio_of_launches(times({1, 2, 3, 4}), times(k_first), 1)) << "four rounds are not of three launches";
}

TEST(SideBySide, there_is_none_of_other_launches_or_caches_or_without_times) {
  for (const auto& ratio_of : {ratio_of_rounds, ratio_of_launches}) {
    EXPECT_FALSE(ratio_of(times(k_second, 2), times(k_first), 1));
    EXPECT_FALSE(ratio_of(times(k_second, 3, true), times(k_first), 1));
    EXPECT_FALSE(ratio_of(times({}), times({}), 1));
    EXPECT_FALSE(ratio_of(times(k_second), times({100, 102, 0, 202, 150, 152}), 1));
  }
}

}  // namespace
}  // namespace clusterbench::measure
