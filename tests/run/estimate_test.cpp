#include "run/estimate.h"

#include <gtest/gtest.h>

#include "run/walk.h"

namespace clusterbench::run::testing {
namespace {

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

}  // namespace
}  // namespace clusterbench::run::testing
