#include "measure/statistics/time_change.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/random.h"
#include "measure/normal.h"

namespace clusterbench::measure {
namespace {

TEST(Change, quantiles_are_those_of_the_published_table) {
  // Student's t, two-sided: Fisher and Yates, table III.
  EXPECT_NEAR(student_quantile(0.05, 1), 12.706, 5e-4);
  EXPECT_NEAR(student_quantile(0.05, 4), 2.776, 5e-4);
  EXPECT_NEAR(student_quantile(0.05, 9), 2.262, 5e-4);
  EXPECT_NEAR(student_quantile(0.01, 9), 3.250, 5e-4);
  EXPECT_NEAR(student_quantile(0.001, 30), 3.646, 5e-4);
  EXPECT_NEAR(student_quantile(0.05, 1e6), 1.960, 5e-4);
}

TEST(Change, tail_and_quantile_are_inverse) {
  for (const double freedom : {1.0, 2.0, 7.0, 60.0})
    for (const double p : {0.5, 0.05, 1e-4, 1e-9})
      EXPECT_NEAR(student_two_sided(student_quantile(p, freedom), freedom) / p, 1.0, 1e-6) << freedom << " " << p;
}

TEST(Change, of_one_degree_of_freedom_the_tail_is_in_closed_form) {
  for (const double t : {0.1, 1.0, 5.0, 1000.0})
    EXPECT_NEAR(student_two_sided(t, 1.0), 1.0 - 2.0 / std::acos(-1.0) * std::atan(t), 1e-12);
}

// Gosset 1908, table of Cushny and Peebles: hours of sleep gained by ten patients, the difference of two drugs;
// t = 4.0621, p = 0.002833.
TEST(Change, students_own_example_comes_out) {
  const Change change{1.58, 1.58 / 4.0621, 9.0};
  EXPECT_NEAR(p_value(change), 0.002833, 5e-7);
}

// The same hours, trimmed: 1.0 1.2 1.3 1.3 1.4 1.8 remain, with mean 8 / 6; with two ends of 1.0 and of 1.8 each in
// place of what was cut off, their variance is 1.004 / 9.
TEST(Change, launches_beyond_the_middle_count_by_their_order_alone) {
  std::array hours{1.2, 2.4, 1.3, 1.3, 0.0, 1.0, 1.8, 0.8, 4.6, 1.4};
  const Change change = change_over_launches(hours);
  EXPECT_NEAR(change.log_ratio, 8.0 / 6.0, 1e-12);
  EXPECT_NEAR(change.error, std::sqrt(1.004 / 9.0) / (0.6 * std::sqrt(10.0)), 1e-12);
  EXPECT_EQ(change.freedom, 5.0);
  hours[8] = 1000.0;
  EXPECT_EQ(change_over_launches(hours).log_ratio, change.log_ratio);
  EXPECT_EQ(change_over_launches(hours).error, change.error);
}

TEST(Change, few_launches_all_count) {
  const Change change = change_over_launches(std::array{1.0, 2.0, 6.0});
  EXPECT_NEAR(change.log_ratio, 3.0, 1e-12);
  EXPECT_NEAR(change.error, std::sqrt(7.0 / 3.0), 1e-12);
  EXPECT_EQ(change.freedom, 2.0);
}

TEST(Change, holm_corrects_step_by_step) {
  // 0.01 x 4, 0.02 x 3, 0.03 x 2 = 0.06, 0.04 x 1 but no less than the one before.
  const std::array p{0.04, 0.01, 0.03, 0.02};
  const std::vector<double> corrected = holm(p);
  EXPECT_DOUBLE_EQ(corrected[1], 0.04);
  EXPECT_DOUBLE_EQ(corrected[3], 0.06);
  EXPECT_DOUBLE_EQ(corrected[2], 0.06);
  EXPECT_DOUBLE_EQ(corrected[0], 0.06);
  EXPECT_DOUBLE_EQ(holm(std::array{0.9, 0.8})[1], 1.0);
  EXPECT_TRUE(holm({}).empty());
}

TEST(Change, rounds_that_were_disturbed_do_not_move_a_launch) {
  const std::array base{100.0, 900.0, 100.0, 700.0, 100.0}, next{110.0, 110.0, 4000.0, 4000.0, 300.0};
  EXPECT_NEAR(launch_log_ratio(base, next), std::log(1.1), 1e-12);
  EXPECT_NEAR(launch_log_ratio(std::array{1.0, 2.0}, std::array{2.0, 6.0}), std::log(3.0 / 1.25), 1e-12);
}

TEST(Change, a_median_s_error_comes_from_its_interval) {
  const MedianTime base{100.0, {98.0, 102.0}, 31}, next{110.0, {107.8, 112.2}, 31};
  const Change change = change_of_medians(base, next);
  EXPECT_NEAR(change.log_ratio, std::log(1.1), 1e-12);
  // Both intervals are ln(102 / 98) wide, which is 2 x 1.96 errors.
  EXPECT_NEAR(change.error, std::sqrt(2.0) * std::log(102.0 / 98.0) / 3.92, 1e-5);
  EXPECT_EQ(change.freedom, 30.0);
}

TEST(Change, of_an_interval_between_launches_the_launches_count) {
  const double width = student_quantile(0.05, 4.0) * 0.01;
  const MedianTime base{100.0, {100.0 * std::exp(-width), 100.0 * std::exp(width)}, 30, 5};
  const Change change = change_of_medians(base, base);
  EXPECT_NEAR(change.error, std::sqrt(2.0) * 0.01, 1e-9);
  EXPECT_EQ(change.freedom, 4.0);
}

TEST(Change, one_launch_concludes_nothing) {
  const Change change = change_over_launches(std::array{0.5});
  EXPECT_EQ(p_value(change), 1.0);
  EXPECT_FALSE(ratio_of(change).ci95.is_known());
  EXPECT_EQ(verdict_on(change, p_value(change), 0.02), Verdict::inconclusive);
  EXPECT_EQ(p_value(change_over_launches({})), 1.0);
}

TEST(Change, two_launches_conclude_nothing_however_alike_they_are) {
  const Change two = change_over_launches(std::array{0.5, 0.5}),
               three = change_over_launches(std::array{0.5, 0.5, 0.5});
  EXPECT_EQ(p_value(two), 1.0);
  EXPECT_FALSE(ratio_of(two).ci95.is_known());
  EXPECT_EQ(verdict_on(two, p_value(two), 0.02), Verdict::inconclusive);
  EXPECT_EQ(verdict_on(three, p_value(three), 0.02), Verdict::slower);
}

Verdict verdict_of(double percent, double error_percent) {
  const Change change{std::log1p(percent / 100.0), error_percent / 100.0, 9};
  return verdict_on(change, p_value(change), 0.02);
}

TEST(Change, a_verdict_needs_certainty_and_size) {
  EXPECT_EQ(verdict_of(3.0, 0.3), Verdict::slower);
  EXPECT_EQ(verdict_of(-3.0, 0.3), Verdict::faster);
  EXPECT_EQ(verdict_of(3.0, 3.0), Verdict::inconclusive) << "large and uncertain";
  EXPECT_EQ(verdict_of(0.5, 0.1), Verdict::same) << "certain and small";
  EXPECT_EQ(verdict_of(0.0, 1.5), Verdict::inconclusive) << "nothing seen, and nothing could have been";
  EXPECT_EQ(verdict_of(1.9, 0.3), Verdict::inconclusive) << "may be below or above the threshold";
  EXPECT_EQ(verdict_of(0.0, 0.0), Verdict::same);
}

// What the rule promises: of comparisons of a program with itself none is called changed, and of 3 % nearly all are
// found, where starts of a program differ by 0.5 %, and one in ten by 30 times as much.
TEST(Change, simulated_comparisons_raise_no_alarm_and_miss_little) {
  constexpr int k_experiments = 400, k_launches = 10, k_cases = 10;
  SplitMix64 random(3);
  int alarms = 0, found = 0;
  for (int i = 0; i < k_experiments; ++i) {
    std::vector<Change> changes;
    std::vector<double> p;
    for (int one = 0; one < k_cases; ++one) {
      std::vector<double> launches(k_launches);
      for (double& launch : launches) launch = (one == 0 ? std::log(1.03) : 0.0) + 0.005 * normal(random);
      launches[random.below(launches.size())] += 0.15 * normal(random);
      changes.push_back(change_over_launches(launches));
      p.push_back(p_value(changes.back()));
    }
    const std::vector<double> corrected = holm(p);
    found += verdict_on(changes[0], corrected[0], 0.02) == Verdict::slower ? 1 : 0;
    for (std::size_t one = 1; one < changes.size(); ++one) {
      const Verdict verdict = verdict_on(changes[one], corrected[one], 0.02);
      alarms += verdict == Verdict::slower || verdict == Verdict::faster ? 1 : 0;
    }
  }
  EXPECT_EQ(alarms, 0);
  EXPECT_GE(found, k_experiments * 97 / 100);
}

}  // namespace
}  // namespace clusterbench::measure
