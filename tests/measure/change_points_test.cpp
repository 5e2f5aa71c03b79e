#include "measure/change_points.h"

#include <gtest/gtest.h>

#include <vector>

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
  EXPECT_LT(points[0].p, 1e-9);
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

TEST(ChangePoints, counts_that_do_not_vary_change_for_certain_and_at_their_second_value) {
  const std::vector<ChangePoint> points = change_points(std::vector<double>{7, 7, 7, 7, 9, 9});
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].index, 4u);
  EXPECT_EQ(points[0].p, 0.0);
  EXPECT_EQ(places({0, 0, 0, 3, 3}), std::vector<std::size_t>{3});  // from nothing
}

TEST(ChangePoints, what_is_too_small_to_matter_is_left_out) {
  const std::vector<double> series = {1000, 1000, 1000, 1001, 1001, 1001};
  EXPECT_EQ(places(series), std::vector<std::size_t>{});
  EXPECT_EQ(places(series, {.max_p = 0.001, .min_change = 0.0}), std::vector<std::size_t>{3});
}

TEST(ChangePoints, what_may_well_be_chance_is_left_out) {
  const std::vector<double> series = steps({{10, 100.0}, {10, 101.0}});
  EXPECT_EQ(places(series), std::vector<std::size_t>{});
  EXPECT_EQ(places(series, {.max_p = 0.01, .min_change = 0.005}), std::vector<std::size_t>{10});
}

TEST(ChangePoints, short_series_have_none) {
  for (std::size_t count = 0; count < 4; ++count)
    EXPECT_EQ(places(std::vector<double>(count, 5.0)), std::vector<std::size_t>{});
  EXPECT_EQ(places({1, 1, 2}), std::vector<std::size_t>{});
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
