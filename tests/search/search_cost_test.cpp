// What a search is about to take: by what it counts, and never by the clock in a test.

#include "search/search_cost.h"

#include <gtest/gtest.h>

#include "run/walk.h"
#include "search/recommend.h"

namespace clusterbench::search {
namespace {

using run::testing::k_shafts;
using run::testing::Walk;

TEST(SearchCosts, grids_are_shared_by_their_candidates_and_the_first_frame_that_is_timed_is_the_dearest) {
  const SearchCosts costs{.grid_ns = 100.0,
                          .candidate_ns = 10.0,
                          .first_frame_timing_ns = 7.0,
                          .frame_timing_ns = 2.0,
                          .last_timing_ns = 1000.0,
                          .timed_frames = 4};
  EXPECT_EQ(costs.counting_ns(20, 5, 1), 5 * 100.0 + 20 * 10.0);
  EXPECT_EQ(costs.counting_ns(3, 5, 2), 2 * (3 * 100.0 + 3 * 10.0));
  EXPECT_EQ(costs.rung_ns(20, 5, 1), 700.0 + 20 * 7.0);
  EXPECT_EQ(costs.rung_ns(20, 5, 16), 16 * 700.0 + 20 * (7.0 + 3 * 2.0)) << "four frames are timed";
  EXPECT_EQ(costs.last_ns(2, 5, 30), 30 * 220.0 + 2 * 1000.0);
  EXPECT_EQ(SearchCosts{}.rung_ns(20, 5, 4), 80.0);
  const Halving planned{{{1, 20, 0, 3}, {4, 3, 0, 2}}, {0, 1}};
  EXPECT_EQ(planned_ns(costs, planned, 5, 30),
            costs.rung_ns(20, 5, 1) + costs.rung_ns(3, 5, 4) + costs.last_ns(2 + k_most_coarse, 5, 30));
}

TEST(SearchCosts, a_look_leaves_the_plan_as_it_was_and_finds_times_only_where_they_are_measured) {
  Walk walk(std::string(k_shafts) + R"(, "assigners": ["aabb", "exact", "bounds"], "storages": ["packed", "bitfield"])",
            6);
  walk.add_light({0, 0, -6}, 3);
  const std::vector<run::GroupPlan> groups = walk.plan.groups;
  for (const bool is_timed : {false, true}) {
    walk.config.timing = {
        .measure = is_timed, .rounds = 2, .min_time_ms = 0.01, .frames = 2, .launches = 1, .sweep_mib = 4};
    const std::vector<View> views = views_of(walk.config, walk.plan);
    const SearchCosts costs = estimated_costs(walk.config, walk.plan, views[0], {});
    ASSERT_EQ(walk.plan.groups.size(), groups.size());
    for (std::size_t i = 0; i < groups.size(); ++i) EXPECT_EQ(walk.plan.groups[i].cases.size(), groups[i].cases.size());
    EXPECT_GT(costs.candidate_ns, 0.0);
    EXPECT_GE(costs.grid_ns, 0.0);
    EXPECT_EQ(costs.last_timing_ns > 0.0, is_timed);
    EXPECT_EQ(costs.first_frame_timing_ns > costs.frame_timing_ns, is_timed);
    EXPECT_EQ(costs.timed_frames, is_timed ? 2u : 0u);
    EXPECT_GT(estimated_s(costs, views[0], {}), 0.0);
  }
}

TEST(SearchCosts, of_a_view_in_which_nothing_can_be_chosen_are_not_sampled) {
  Walk walk(std::string(k_shafts) + R"(, "assigners": ["aabb"], "storages": ["packed"])", 6);
  std::vector<View> views = views_of(walk.config, walk.plan);
  views[0].candidates.clear();
  const SearchCosts costs = estimated_costs(walk.config, walk.plan, views[0], {});
  EXPECT_EQ(costs.candidate_ns, SearchCosts{}.candidate_ns);
  EXPECT_EQ(costs.grid_ns, 0.0);
}

}  // namespace
}  // namespace clusterbench::search
