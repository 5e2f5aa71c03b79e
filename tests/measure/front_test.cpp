#include "measure/statistics/front.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace clusterbench::measure {
namespace {

using Places = std::vector<std::size_t>;

// Of cases whose times are known exactly: time, bytes, overshade.
Places front_of(const std::vector<std::array<double, 3>>& cases) {
  std::vector<Costs> costs;
  for (const auto& [time, bytes, overshade] : cases) costs.push_back({{time, time}, bytes, overshade});
  return pareto_front(costs, intervals_apart(costs));
}

TEST(Front, what_is_worse_in_every_respect_is_not_on_it) {
  EXPECT_EQ(front_of({{1, 1, 1}, {2, 2, 2}}), (Places{0}));
}

TEST(Front, whoever_is_best_in_one_respect_is_on_it) {
  EXPECT_EQ(front_of({{1, 5, 5}, {5, 1, 5}, {5, 5, 1}, {5, 5, 5}}), (Places{0, 1, 2}));
}

TEST(Front, a_tie_in_two_respects_is_decided_by_the_third) {
  EXPECT_EQ(front_of({{1, 1, 2}, {1, 1, 1}}), (Places{1}));
}

TEST(Front, equal_cases_all_stay) {
  EXPECT_EQ(front_of({{1, 2, 3}, {1, 2, 3}}), (Places{0, 1}));
}

TEST(Front, what_is_not_known_counts_as_the_worst) {
  const double unknown = std::nan("");
  EXPECT_EQ(front_of({{1, 1, unknown}, {1, 1, 1}}), (Places{1}));
  EXPECT_EQ(front_of({{unknown, 1, unknown}, {unknown, 2, unknown}}), (Places{0}));
}

TEST(Front, of_equal_ones_without_times_those_go_that_are_known_to_be_slower) {
  const auto front = [](int a, int b, double bytes_b = 2) {
    std::vector<Costs> costs{{{Costs::k_unknown, Costs::k_unknown}, 2, 3, a},
                             {{Costs::k_unknown, Costs::k_unknown}, bytes_b, 3, b}};
    return pareto_front(costs, intervals_apart(costs));
  };
  EXPECT_EQ(front(1, 3), (Places{0}));
  EXPECT_EQ(front(2, 1), (Places{1}));
  EXPECT_EQ(front(1, 1), (Places{0, 1}));
  EXPECT_EQ(front(0, 3), (Places{0, 1})) << "of the first nothing is known";
  EXPECT_EQ(front(1, 3, 1), (Places{1})) << "it is smaller";
}

TEST(Front, times_whose_intervals_overlap_are_the_same_time) {
  const auto front = [](Interval a, Interval b, double overshade_b) {
    const std::vector<Costs> costs{{a, 1, 2}, {b, 1, overshade_b}};
    return pareto_front(costs, intervals_apart(costs));
  };
  EXPECT_EQ(front({90, 110}, {100, 120}, 2), (Places{0, 1})) << "nothing says that the first is faster";
  EXPECT_EQ(front({90, 110}, {100, 120}, 1), (Places{1})) << "nor that it is for its longer lists";
  EXPECT_EQ(front({90, 110}, {111, 120}, 2), (Places{0}));
  EXPECT_EQ(front({90, 110}, {111, 120}, 1), (Places{0, 1}));
}

TEST(Front, times_are_told_apart_by_whoever_knows_more_than_intervals) {
  const std::vector<Costs> costs{{{90, 200}, 1, 2}, {{95, 210}, 1, 2}};
  const auto second_takes_longer = [](std::size_t index, std::size_t other) { return index == 1 && other == 0; };
  EXPECT_EQ(pareto_front(costs, intervals_apart(costs)), (Places{0, 1}));
  EXPECT_EQ(pareto_front(costs, second_takes_longer), (Places{0}));
}

TEST(Front, of_nothing_is_empty) {
  EXPECT_TRUE(front_of({}).empty());
}

}  // namespace
}  // namespace clusterbench::measure
