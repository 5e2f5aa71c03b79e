#include "run/estimate.h"

#include <gtest/gtest.h>

#include "core/memory.h"
#include "run/walk.h"

namespace clusterbench::run {
namespace {

using testing::k_shafts;
using testing::Walk;

// Rounds that have to last so long that nothing else matters; none of them is measured.
Walk long_walk(const std::string& more) {
  Walk walk(std::string(k_shafts) + ", " + more, 3);
  walk.config.timing = {
      .measure = true, .rounds = 20, .min_time_ms = 60000.0, .frames = 2, .launches = 5, .sweep_mib = 4};
  walk.add_light({0, 0, -6}, 3);
  return walk;
}

TEST(Estimate, of_long_rounds_is_their_number_by_their_least_time) {
  const double one =
      estimated_s(long_walk(R"("assigners": ["aabb"])").config, long_walk(R"("assigners": ["aabb"])").plan);
  EXPECT_GE(one, 20 * 60.0);
  EXPECT_LE(one, 2 * 20 * 60.0);
  const Walk two = long_walk(R"("assigners": ["aabb", "planes"])");
  EXPECT_NEAR(estimated_s(two.config, two.plan) / one, 2.0, 0.1) << "methods";
  Walk fewer = long_walk(R"("assigners": ["aabb"])");
  fewer.config.timing.rounds = 10;
  EXPECT_NEAR(estimated_s(fewer.config, fewer.plan) / one, 0.5, 0.1) << "rounds of all launches together";
  Walk counted = long_walk(R"("assigners": ["aabb"])");
  counted.config.timing.measure = false;
  EXPECT_LT(estimated_s(counted.config, counted.plan), 20 * 60.0);
  EXPECT_GT(estimated_s(counted.config, counted.plan), 0.0);
}

// One grid on cameras with so many frames.
Walk walk_of_cameras(const std::vector<int>& frames) {
  Walk walk(std::string(k_shafts) + R"(, "assigners": ["aabb", "exact"], "storages": ["packed"], "threads": 1)", 1);
  walk.add_light({0, 0, -6}, 3);
  const scene::CameraPath path = walk.plan.scenes[0].paths[0];
  const GroupPlan group = walk.plan.groups[0];
  walk.plan.scenes[0].paths.clear();
  walk.plan.groups.clear();
  for (std::size_t camera = 0; camera < frames.size(); ++camera) {
    walk.plan.scenes[0].paths.push_back(path);
    walk.plan.scenes[0].paths[camera].shots.assign(static_cast<std::size_t>(frames[camera]), path.shots[0]);
    walk.plan.groups.push_back(group);
    walk.plan.groups[camera].camera = camera;
    for (CasePlan& one : walk.plan.groups[camera].cases) one.camera = camera;
  }
  return walk;
}

constexpr EstimateLimits k_first_alone{.most_s = 0.0}, k_one_frame{.most_s = 0.0, .counts_one_frame = true};

TEST(Estimate, of_groups_that_are_not_sampled_follows_their_frames) {
  const Walk walk = walk_of_cameras({4, 1, 100});
  const std::vector<GroupCost> costs = estimated_costs(walk.config, walk.plan, k_first_alone);
  EXPECT_GT(costs[1].counting_ns, 0.0);
  EXPECT_NEAR(costs[2].counting_ns / costs[1].counting_ns, 100.0, 2.0);
}

TEST(Estimate, of_one_frame_does_not_depend_on_how_many_there_are) {
  const Walk walk = walk_of_cameras({4, 1, 100});
  const std::vector<GroupCost> costs = estimated_costs(walk.config, walk.plan, k_one_frame);
  EXPECT_GT(costs[1].counting_ns, 0.0);
  EXPECT_NEAR(costs[2].counting_ns / costs[1].counting_ns, 1.0, 0.02);
}

// The first grid's lists take more than a MiB.
TEST(Estimate, is_not_lowered_by_a_group_that_fails) {
  const config::Config config = config::parse_config(R"({"scenes": [{"rig": {"lights": 40, "range": 20}}],
      "grids": [{"tiles": {"count": [100, 100]}, "slices": {"count": 60, "near": 0.1, "far": 60}},
                {"tiles": {"count": [5, 4]}, "slices": {"count": 6, "near": 0.1, "far": 60}},
                {"tiles": {"count": [5, 4]}, "slices": {"count": 6, "near": 0.1, "far": 60.5}}],
      "assigners": ["aabb"], "storages": ["packed"], "limits": {"memory_mib": 1},
      "timing": {"measure": false}, "threads": 2})",
                                                     "c.json");
  const MemoryLimitScope limit(memory_limit());  // make_plan() sets the configuration's
  const Plan plan = make_plan(config, "");
  const std::vector<GroupCost> costs = estimated_costs(config, plan, k_first_alone);
  ASSERT_EQ(costs.size(), 3U);
  EXPECT_GT(costs[1].counting_ns, 0.0);
  EXPECT_NEAR(costs[2].counting_ns / costs[1].counting_ns, 1.0, 0.1);
}

}  // namespace
}  // namespace clusterbench::run
