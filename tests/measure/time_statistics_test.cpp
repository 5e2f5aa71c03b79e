#include "measure/statistics/time_statistics.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>

#include "core/random.h"
#include "measure/normal.h"
#include "measure/recorded_launches.h"

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
  const std::array own{20.0, 40.0, 60.0, 20.0, 40.0, 60.0}, other{10.0, 20.0, 30.0, 10.0, 20.0, 30.0};
  const Ratio ratio = paired_ratio(own, other, 1);
  EXPECT_EQ(ratio.ratio, 2.0);
  EXPECT_EQ(ratio.ci95.low, 2.0);
  EXPECT_EQ(ratio.ci95.high, 2.0);
}

// Between five values of any distribution the median lies with 1 - 2 / 2^5, between six with 1 - 2 / 2^6.
TEST(Timing, an_interval_takes_six_rounds_of_one_launch_or_three_launches) {
  const std::array<double, 12> some{5, 1, 9, 2, 4, 7, 3, 8, 6, 5, 2, 4};
  const auto is_known = [&](std::size_t count, int launches) {
    const std::span<const double> samples = std::span(some).first(count);
    EXPECT_EQ(paired_ratio(samples, samples, 1, launches).ci95.is_known(),
              time_stats(samples, 1, launches).ci95.is_known());
    return time_stats(samples, 1, launches).ci95.is_known();
  };
  EXPECT_FALSE(is_known(0, 1) || is_known(1, 1) || is_known(5, 1));
  EXPECT_TRUE(is_known(6, 1));
  EXPECT_FALSE(is_known(2, 2) || is_known(12, 2)) << "one degree of freedom: 12.7 errors on either side";
  EXPECT_TRUE(is_known(3, 3) && is_known(12, 4));
  EXPECT_FALSE(is_known(11, 3)) << "launches of different lengths";
}

TEST(Timing, of_no_samples_everything_is_zero) {
  EXPECT_EQ(time_stats({}, 1).median, 0.0);
  EXPECT_EQ(paired_ratio({}, {}, 1).ratio, 0.0);
}

TEST(WorstFrame, is_the_frame_with_the_largest_share_of_a_pass) {
  // Rounds of two frames; the second takes three quarters of a pass, whatever the clock adds.
  std::vector<std::vector<double>> frames{scaled_to_mean({100, 300}, 2, 180), scaled_to_mean({110, 330}, 2, 200),
                                          scaled_to_mean({500, 1500}, 2, 190)};
  EXPECT_FALSE(worst_frame(frames, 2, 190, 1).ci95.is_known());
  frames.insert(frames.end(), {frames[0], frames[1], frames[2]});
  const WorstFrame worst = worst_frame(frames, 2, 190, 1);
  EXPECT_EQ(worst.index, 1u);
  EXPECT_DOUBLE_EQ(worst.ns, 1.5 * 190);
  EXPECT_DOUBLE_EQ(worst.ci95.low, 1.5 * 180);
  EXPECT_DOUBLE_EQ(worst.ci95.high, 1.5 * 200);
}

TEST(WorstFrame, of_one_frame_is_the_mean) {
  const std::vector<std::vector<double>> frames{scaled_to_mean({100}, 1, 70), scaled_to_mean({130}, 1, 80),
                                                scaled_to_mean({90}, 1, 90)};
  EXPECT_EQ(worst_frame(frames, 1, 80, 1).ns, 80.0);
}

TEST(WorstFrame, is_never_faster_than_the_mean) {
  // Another frame is disturbed in each round: no frame's own median has it, the median of the means does.
  const std::vector<std::vector<double>> frames{{400, 100, 101, 500}, {100, 400, 101, 100}, {100, 100, 401, 100}};
  const WorstFrame worst = worst_frame(frames, 3, 200, 1);
  EXPECT_EQ(worst.index, 2u);
  EXPECT_DOUBLE_EQ(worst.ns, 101.0 * 600.0 / 301.0);
}

TEST(WorstFrame, a_frame_beyond_the_mean_is_scaled_and_not_in_it) {
  EXPECT_EQ(scaled_to_mean({100, 300, 600}, 2, 400), (std::vector<double>{200, 600, 1200}));
}

// The share of intervals that hold the true median of 100, where launches differ by 5 % and rounds by 1 %; in some
// launches another program takes half as much again.
double share_held(int launches, int rounds, bool knows_launches, double busy_share) {
  const int experiments = knows_launches ? 1000 : 100;  // a bootstrap takes long
  SplitMix64 random(17);
  int held = 0;
  for (int i = 0; i < experiments; ++i) {
    std::vector<double> samples;
    for (int launch = 0; launch < launches; ++launch) {
      const double own = 100.0 * std::exp(0.05 * normal(random)) * (random.unit() < busy_share ? 1.5 : 1.0);
      for (int round = 0; round < rounds; ++round) samples.push_back(own * std::exp(0.01 * normal(random)));
    }
    const Interval ci95 = time_stats(samples, static_cast<std::uint64_t>(i), knows_launches ? launches : 1).ci95;
    held += ci95.low <= 100.0 && 100.0 <= ci95.high ? 1 : 0;
  }
  return static_cast<double>(held) / experiments;
}

TEST(Launches, intervals_between_them_hold_the_true_median_and_those_of_rounds_do_not) {
  for (const int launches : {3, 5, 10}) {
    EXPECT_GE(share_held(launches, 3, true, 0.0), 0.93) << launches;
    EXPECT_GE(share_held(launches, 3, true, 0.05), 0.90) << launches;
  }
  EXPECT_LT(share_held(5, 30, false, 0.0), 0.8);
  EXPECT_LT(share_held(1, 30, false, 0.0), 0.2);
}

constexpr std::size_t k_recorded_rounds = 3;

// Of recorded launches some that were drawn at random, without repetition.
std::vector<std::size_t> drawn_launches(SplitMix64& random, std::size_t wanted, std::size_t all) {
  std::vector<std::size_t> order(all);
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = 0; i < wanted; ++i) std::swap(order[i], order[i + random.below(all - i)]);
  order.resize(wanted);
  return order;
}

std::vector<double> rounds_of(std::span<const double> recorded, const std::vector<std::size_t>& launches) {
  std::vector<double> out;
  for (const std::size_t launch : launches)
    for (std::size_t round = 0; round < k_recorded_rounds; ++round)
      out.push_back(recorded[launch * k_recorded_rounds + round]);
  return out;
}

TEST(Launches, of_recorded_ones_any_few_have_intervals_that_hold_the_median_of_all) {
  const std::span<const double> exact = k_recorded_exact_fast, aabb = k_recorded_aabb_fast;
  const std::size_t all = exact.size() / k_recorded_rounds;
  const double true_time = time_stats(exact, 1).median, true_ratio = paired_ratio(exact, aabb, 1).ratio;
  constexpr int k_draws = 1000;
  for (const std::size_t launches : {3u, 5u, 10u}) {
    SplitMix64 random(launches);
    int times = 0, ratios = 0;
    for (int i = 0; i < k_draws; ++i) {
      const std::vector<std::size_t> some = drawn_launches(random, launches, all);
      const std::vector<double> own = rounds_of(exact, some), other = rounds_of(aabb, some);
      const Interval time = time_stats(own, 1, static_cast<int>(launches)).ci95,
                     ratio = paired_ratio(own, other, 1, static_cast<int>(launches)).ci95;
      times += time.low <= true_time && true_time <= time.high ? 1 : 0;
      ratios += ratio.low <= true_ratio && true_ratio <= ratio.high ? 1 : 0;
    }
    EXPECT_GE(times, k_draws * 93 / 100) << launches;
    EXPECT_GE(ratios, k_draws * 93 / 100) << launches;
  }
}

TEST(Launches, have_medians_where_each_has_as_many_rounds) {
  EXPECT_EQ(launch_medians(std::vector{3.0, 1.0, 2.0, 9.0, 7.0, 8.0}, 2), (std::vector{2.0, 8.0}));
  EXPECT_EQ(launch_medians(std::vector{3.0, 1.0, 9.0, 7.0}, 2), (std::vector{2.0, 8.0}));
  EXPECT_TRUE(launch_medians(std::vector{3.0, 1.0, 9.0}, 2).empty());
}

TEST(Launches, a_ratio_knows_as_many_values_as_there_were_launches) {
  // 2, 2.2 and 1.8 in the launches, and no noise within.
  const std::array own{200.0, 400.0, 220.0, 440.0, 180.0, 360.0}, other{100.0, 200.0, 100.0, 200.0, 100.0, 200.0};
  const Ratio of_launches = paired_ratio(own, other, 1, 3);
  EXPECT_EQ(of_launches.ratio, 2.0);
  // Student's t of two degrees of freedom: 4.303 errors of the mean logarithm.
  const std::array logs{std::log(2.0), std::log(2.2), std::log(1.8)};
  const double mean = (logs[0] + logs[1] + logs[2]) / 3.0;
  double squares = 0.0;
  for (const double value : logs) squares += (value - mean) * (value - mean);
  EXPECT_NEAR(std::log(of_launches.ci95.high), mean + 4.3027 * std::sqrt(squares / 6.0), 1e-4);
  EXPECT_NEAR(std::log(of_launches.ci95.low), mean - 4.3027 * std::sqrt(squares / 6.0), 1e-4);
}

TEST(Launches, the_interval_of_swapped_methods_is_the_inverse) {
  const std::array own{200.0, 390.0, 220.0, 440.0, 180.0, 350.0}, other{100.0, 200.0, 100.0, 210.0, 100.0, 200.0};
  const Ratio there = paired_ratio(own, other, 1, 3), back = paired_ratio(other, own, 1, 3);
  EXPECT_NEAR(there.ci95.low * back.ci95.high, 1.0, 1e-3);
  EXPECT_NEAR(there.ci95.high * back.ci95.low, 1.0, 1e-3);
}

template <class Sample>
double share_with_two_modes(std::size_t count, const Sample& sample) {
  SplitMix64 random(23);
  int found = 0;
  for (int i = 0; i < 2000; ++i) {
    std::vector<double> samples;
    for (std::size_t j = 0; j < count; ++j) samples.push_back(sample(random));
    found += two_modes(samples) ? 1 : 0;
  }
  return found / 2000.0;
}

TEST(TwoModes, are_seldom_seen_in_one_and_mostly_found_in_two) {
  const auto bell = [](SplitMix64& random) { return 100.0 * std::exp(0.1 * normal(random)); };
  const auto tail = [](SplitMix64& random) { return 100.0 - 20.0 * std::log(1.0 - random.unit()); };
  const auto heavy = [](SplitMix64& random) {
    return 100.0 * (1.0 + 0.05 * std::abs(std::tan(M_PI * (random.unit() - 0.5))));
  };
  const auto two = [](SplitMix64& random) {
    return (random.unit() < 0.5 ? 100.0 : 120.0) * std::exp(0.02 * normal(random));
  };
  for (const std::size_t count : {15u, 20u, 40u}) {
    EXPECT_LE(share_with_two_modes(count, bell), 0.012) << count;
    EXPECT_LE(share_with_two_modes(count, tail), 0.012) << count;
    EXPECT_LE(share_with_two_modes(count, heavy), 0.012) << count;
  }
  EXPECT_GE(share_with_two_modes(15, two), 0.7);
  EXPECT_EQ(share_with_two_modes(14, two), 0.0);
}

TEST(TwoModes, of_rounds_that_alternate_are_told) {
  std::vector<double> samples;
  for (int i = 0; i < 20; ++i) samples.push_back((i % 2 == 0 ? 16.3 : 20.3) + 0.01 * i);
  const std::optional<TwoModes> modes = two_modes(samples);
  ASSERT_TRUE(modes);
  EXPECT_NEAR(modes->low, 16.4, 0.1);
  EXPECT_NEAR(modes->high, 20.4, 0.1);
}

}  // namespace
}  // namespace clusterbench::measure
