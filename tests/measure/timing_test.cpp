#include "measure/timing.h"

#include <gtest/gtest.h>

#include <array>

#include "core/random.h"

namespace clusterbench::measure {
namespace {

TEST(Timing, an_outlier_moves_neither_median_nor_deviation) {
  const TimeStats stats = time_stats(std::array{12.0, 10.0, 11.0, 13.0, 9000.0}, 1);
  EXPECT_EQ(stats.median, 12.0);
  EXPECT_EQ(stats.mad, 1.0);  // 2, 1, 0, 1, 8988
  EXPECT_EQ(stats.min, 10.0);
  EXPECT_EQ(stats.p95, 9000.0);
}

TEST(Timing, of_an_even_count_the_median_is_between_the_middle_two) {
  const TimeStats stats = time_stats(std::array{4.0, 1.0, 2.0, 8.0}, 1);
  EXPECT_EQ(stats.median, 3.0);
  EXPECT_EQ(stats.mad, 1.5);  // 1, 2, 1, 5
}

TEST(Timing, samples_stay_in_the_order_measured) {
  const std::vector<double> samples{5.0, 1.0, 9.0, 2.0};
  EXPECT_EQ(time_stats(samples, 1).samples, samples);
}

TEST(Timing, the_same_seed_gives_the_same_interval) {
  std::vector<double> samples;
  SplitMix64 random(5);
  for (int i = 0; i < 31; ++i) samples.push_back(random.between(100.0, 200.0));
  const Interval first = time_stats(samples, 7).ci95, again = time_stats(samples, 7).ci95;
  EXPECT_EQ(first.low, again.low);
  EXPECT_EQ(first.high, again.high);
}

TEST(Timing, the_interval_holds_the_median_and_lies_within_the_samples) {
  std::vector<double> samples;
  SplitMix64 random(6);
  for (int i = 0; i < 31; ++i) samples.push_back(random.between(100.0, 200.0));
  const TimeStats stats = time_stats(samples, 1);
  EXPECT_LT(stats.ci95.low, stats.median);
  EXPECT_GT(stats.ci95.high, stats.median);
  EXPECT_GE(stats.ci95.low, stats.min);
}

// What 95 % means: of many experiments, about that many intervals hold the true median.
TEST(Timing, nearly_all_intervals_hold_the_true_median) {
  constexpr int k_experiments = 400;
  int held = 0;
  SplitMix64 random(11);
  for (int i = 0; i < k_experiments; ++i) {
    std::array<double, 31> samples{};
    for (double& sample : samples) sample = random.unit();
    const Interval interval = time_stats(samples, static_cast<std::uint64_t>(i)).ci95;
    held += interval.low <= 0.5 && 0.5 <= interval.high ? 1 : 0;
  }
  EXPECT_GE(held, k_experiments * 91 / 100);
  EXPECT_LE(held, k_experiments * 99 / 100);
}

TEST(Timing, ratios_are_taken_pair_by_pair) {
  // The machine slows down threefold; the ratio does not care.
  const std::array own{20.0, 40.0, 60.0}, other{10.0, 20.0, 30.0};
  const Ratio ratio = paired_ratio(own, other, 1);
  EXPECT_EQ(ratio.ratio, 2.0);
  EXPECT_EQ(ratio.ci95.low, 2.0);
  EXPECT_EQ(ratio.ci95.high, 2.0);
}

TEST(Timing, of_no_samples_everything_is_zero) {
  EXPECT_EQ(time_stats({}, 1).median, 0.0);
  EXPECT_EQ(paired_ratio({}, {}, 1).ratio, 0.0);
}

TEST(WorstFrame, is_the_frame_with_the_largest_share_of_a_pass) {
  // Three rounds of two frames; the second takes three quarters of a pass, whatever the clock adds.
  const std::vector<std::vector<double>> frames{{100, 300}, {110, 330}, {500, 1500}};
  const std::vector<double> pass{180, 200, 190};
  const WorstFrame worst = worst_frame(frames, pass, 1);
  EXPECT_EQ(worst.place, 1u);
  EXPECT_DOUBLE_EQ(worst.ns, 1.5 * 190);
  EXPECT_DOUBLE_EQ(worst.ci95.low, 1.5 * 180);
  EXPECT_DOUBLE_EQ(worst.ci95.high, 1.5 * 200);
}

TEST(WorstFrame, of_one_frame_is_the_mean) {
  const std::vector<std::vector<double>> frames{{100}, {130}, {90}};
  const std::vector<double> pass{70, 80, 90};
  EXPECT_EQ(worst_frame(frames, pass, 1).ns, 80.0);
}

}  // namespace
}  // namespace clusterbench::measure
