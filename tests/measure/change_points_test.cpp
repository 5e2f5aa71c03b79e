#include "measure/statistics/change_points.h"

#include <gtest/gtest.h>

#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "effort.h"

namespace clusterbench::measure {
namespace {

std::vector<std::size_t> places(const std::vector<double>& series, const ChangeRule& rule = {}) {
  std::vector<std::size_t> out;
  for (const ChangePoint& point : change_points(series, rule)) out.push_back(point.index);
  return out;
}

// A noise of ten fixed values between -1 and 1, over and over.
double noise(std::size_t i) {
  constexpr double k_noise[] = {0.3, -0.7, 0.1, 0.9, -0.4, -0.9, 0.6, -0.2, 0.8, -0.5};
  return k_noise[i % 10];
}

std::vector<double> steps(const std::vector<std::pair<std::size_t, double>>& stretches) {
  std::vector<double> series;
  for (const auto& [count, level] : stretches)
    for (std::size_t i = 0; i < count; ++i) series.push_back(level + noise(series.size()));
  return series;
}

TEST(ChangePoints, a_step_is_found_where_it_is_made_by_hand) {
  const std::vector<ChangePoint> points = change_points(steps({{20, 100.0}, {20, 105.0}}));
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].index, 20u);
  EXPECT_NEAR(points[0].before, 100.0, 1e-9);
  EXPECT_NEAR(points[0].after, 105.0, 1e-9);
  EXPECT_GT(points[0].p, 0.0);
  EXPECT_LT(points[0].p, 0.001);
}

TEST(ChangePoints, a_rise_that_is_taken_back_is_two_changes) {
  EXPECT_EQ(places(steps({{15, 100.0}, {10, 110.0}, {15, 100.0}})), (std::vector<std::size_t>{15, 25}));
}

TEST(ChangePoints, noise_has_none) {
  EXPECT_EQ(places(steps({{40, 100.0}})), std::vector<std::size_t>{});
}

TEST(ChangePoints, one_outlier_is_none) {
  std::vector<double> series = steps({{30, 100.0}});
  series[17] = 140.0;
  EXPECT_EQ(places(series), std::vector<std::size_t>{});
}

TEST(ChangePoints, of_noise_few_values_prove_nothing) {
  EXPECT_EQ(least_values(0.001), 14u);
  EXPECT_EQ(least_values(0.05), 8u);
  EXPECT_EQ(least_values(1.0), 4u);
  EXPECT_EQ(places(steps({{6, 100.0}, {7, 200.0}})), std::vector<std::size_t>{});
  EXPECT_EQ(places({100, 101, 100, 101, 200, 201, 200, 201}), std::vector<std::size_t>{});
  EXPECT_EQ(places(steps({{7, 100.0}, {7, 200.0}})), std::vector<std::size_t>{7});
}

TEST(ChangePoints, a_step_at_the_end_is_seen_from_its_third_of_25_values_on) {
  EXPECT_EQ(places(steps({{22, 100.0}, {2, 120.0}})), std::vector<std::size_t>{});
  EXPECT_EQ(places(steps({{22, 100.0}, {3, 120.0}})), std::vector<std::size_t>{22});
}

TEST(ChangePoints, what_is_too_small_to_matter_is_left_out) {
  std::vector<double> series = steps({{20, 1000.0}, {20, 1004.0}});
  EXPECT_EQ(places(series), std::vector<std::size_t>{});
  EXPECT_EQ(places(series, {.max_p = 0.001, .min_change = 0.0}), std::vector<std::size_t>{20});
}

TEST(ChangePoints, what_may_well_be_chance_is_left_out) {
  const std::vector<double> series = steps({{10, 100.0}, {10, 101.0}});
  EXPECT_EQ(places(series), std::vector<std::size_t>{});
  EXPECT_EQ(places(series, {.max_p = 0.05, .min_change = 0.005}), std::vector<std::size_t>{10});
  EXPECT_EQ(places(steps({{20, 100.0}, {20, 200.0}}), {.max_p = 0.0}), std::vector<std::size_t>{});
}

TEST(ChangePoints, short_or_constant_series_have_none) {
  for (const std::size_t count : {0u, 1u, 2u, 3u, 4u, 5u, 40u})
    EXPECT_EQ(places(std::vector<double>(count, 5.0)), std::vector<std::size_t>{});
  EXPECT_EQ(places({1, 1, 2}), std::vector<std::size_t>{});
}

std::vector<std::size_t> counted_places(const std::vector<double>& series, double min_change = 0.005) {
  std::vector<std::size_t> out;
  for (const ChangePoint& point : counted_changes(series, min_change)) out.push_back(point.index);
  return out;
}

TEST(ChangePoints, counts_change_at_once_and_for_certain) {
  const std::vector<ChangePoint> points = counted_changes(std::vector<double>{7, 7, 7, 9}, 0.005);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].index, 3u);
  EXPECT_EQ(points[0].before, 7.0);
  EXPECT_EQ(points[0].after, 9.0);
  EXPECT_EQ(points[0].p, 0.0);
  EXPECT_EQ(counted_places({7, 7, 9, 7}), (std::vector<std::size_t>{2, 3}));
  EXPECT_EQ(counted_places({0, 0, 3, 3}), std::vector<std::size_t>{2}) << "from nothing";
  EXPECT_EQ(counted_places({}), std::vector<std::size_t>{});
}

TEST(ChangePoints, small_steps_of_counts_matter_once_they_add_up) {
  EXPECT_EQ(counted_places({1000, 1001, 1000}), std::vector<std::size_t>{});
  EXPECT_EQ(counted_places({1000, 1001, 1000}, 0.0), (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(counted_places({1000, 1003, 1006, 1009}), std::vector<std::size_t>{2});
}

// 299.5 lights were in no commit.
TEST(ChangePoints, counts_are_told_as_they_were) {
  const std::vector<ChangePoint> points = counted_changes(std::vector<double>{300, 299, 310, 311}, 0.005);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].before, 300.0);
  EXPECT_EQ(points[0].after, 310.0);
}

using Noise = double (*)(SplitMix64&);

double normal_noise(SplitMix64& random) {
  return std::sqrt(-2.0 * std::log(1.0 - random.unit())) * std::cos(2.0 * std::acos(-1.0) * random.unit());
}
double skewed_noise(SplitMix64& random) {
  return std::exp(normal_noise(random));
}
double cauchy_noise(SplitMix64& random) {
  return std::tan(std::acos(-1.0) * (random.unit() - 0.5));
}
// Each result comes from one of three hosts, which differ by five times the noise.
double noise_of_hosts(SplitMix64& random) {
  return normal_noise(random) + 5.0 * static_cast<double>(random.below(3));
}

int alarms_of(Noise noise, std::size_t length, int flat_series, double max_p) {
  SplitMix64 random(length);
  int alarms = 0;
  for (int i = 0; i < flat_series; ++i) {
    std::vector<double> series(length);
    for (double& value : series) value = 1000.0 + noise(random);
    alarms += change_points(series, {max_p, 0.0}).empty() ? 0 : 1;
  }
  return alarms;
}

// The most alarms that a rate of `max_p` exceeds once in 10,000 times.
int most_alarms(int series, double max_p) {
  const boost::math::binomial_distribution<> alarms(series, max_p);
  return static_cast<int>(boost::math::quantile(boost::math::complement(alarms, 1e-4)));
}

TEST(ChangePoints, flat_series_raise_no_more_false_alarms_than_allowed) {
  const int k_series = test::tries(2000);
  for (const double max_p : {0.001, 0.05})
    for (const Noise noise : {normal_noise, skewed_noise, cauchy_noise, noise_of_hosts})
      for (const std::size_t length : {10u, 14u, 30u, 100u})
        EXPECT_LE(alarms_of(noise, length, k_series, max_p), most_alarms(k_series, max_p)) << length << " at " << max_p;
}

TEST(ChangePoints, three_percent_in_noise_of_one_percent_are_found_in_thirty_values) {
  constexpr int k_series = 200;
  SplitMix64 random(3);
  int found = 0;
  for (int i = 0; i < k_series; ++i) {
    std::vector<double> series(30);
    for (std::size_t at = 0; at < series.size(); ++at)
      series[at] = (at < 15 ? 100.0 : 103.0) * (1.0 + 0.01 * normal_noise(random));
    const std::vector<ChangePoint> points = change_points(series);
    found += points.size() == 1 && points[0].index >= 13 && points[0].index <= 17 ? 1 : 0;
  }
  EXPECT_GE(found, k_series * 95 / 100);
}

// The annual flow of the Nile at Aswan, 1871 to 1970 (Cobb 1978), the textbook's change point: after 1898.
TEST(ChangePoints, the_nile_changes_after_1898) {
  const std::vector<double> flow = {
      1120, 1160, 963,  1210, 1160, 1160, 813,  1230, 1370, 1140, 995,  935,  1110, 994, 1020, 960,  1180,
      799,  958,  1140, 1100, 1210, 1150, 1250, 1260, 1220, 1030, 1100, 774,  840,  874, 694,  940,  833,
      701,  916,  692,  1020, 1050, 969,  831,  726,  456,  824,  702,  1120, 1100, 832, 764,  821,  768,
      845,  864,  862,  698,  845,  744,  796,  1040, 759,  781,  865,  845,  944,  984, 897,  822,  1010,
      771,  676,  649,  846,  812,  742,  801,  1040, 860,  874,  848,  890,  744,  749, 838,  1050, 918,
      986,  797,  923,  975,  815,  1020, 906,  901,  1170, 912,  746,  919,  718,  714, 740};
  ASSERT_EQ(flow.size(), 100u);
  const std::vector<ChangePoint> points = change_points(flow);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(1871 + points[0].index, 1899u);  // the first year of the lower flow
  EXPECT_NEAR(points[0].before, 1097.75, 1e-9);
  EXPECT_NEAR(points[0].after, 849.97, 0.005);
}

}  // namespace
}  // namespace clusterbench::measure
