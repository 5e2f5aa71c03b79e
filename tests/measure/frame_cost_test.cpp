// The model of a frame's cost, by hand.

#include "measure/statistics/frame_cost.h"

#include <gtest/gtest.h>

namespace clusterbench::measure {
namespace {

TEST(FrameCost, is_assignment_upload_traffic_and_each_light_that_a_sample_loops_over) {
  const CostModel model{.ns_per_light = 0.02, .upload_gb_per_s = 10.0, .memory_gb_per_s = 400.0};
  const FrameCost cost = frame_cost(model, 5000.0, 20000.0, 1e6, {{1000.0, 7.0, 1.5}, {50.0, 2.0, 1.0}});
  EXPECT_DOUBLE_EQ(cost.upload_ns, 2000.0);
  EXPECT_DOUBLE_EQ(cost.traffic_ns, 2500.0);
  EXPECT_DOUBLE_EQ(cost.shade_ns, 1000 * 7 * 1.5 * 0.02 + 50 * 2 * 0.02);
  EXPECT_DOUBLE_EQ(cost.gpu_ns(), 2000.0 + 2500.0 + 212.0);
  EXPECT_DOUBLE_EQ(cost.frame_ns().value(), 5000.0 + 4712.0);
}

TEST(FrameCost, charges_what_samples_read_by_elements_and_by_bytes) {
  CostModel model{.ns_per_light = 0.02, .ns_per_read = 0.005, .read_gb_per_s = 2000.0};
  const ShadedSamples walk{.samples = 1000.0, .lights = 4.0, .divergence = 2.0, .reads = 60.0, .read_bytes = 1700.0};
  EXPECT_DOUBLE_EQ(walk.read_ns(model), 1000.0 * 2.0 * (60.0 * 0.005 + 1700.0 / 2000.0));
  EXPECT_DOUBLE_EQ(walk.ns(model), walk.read_ns(model) + 1000.0 * 2.0 * 4.0 * 0.02);
  const FrameCost cost = frame_cost(model, {}, 0.0, 0.0, {walk});
  EXPECT_DOUBLE_EQ(cost.gpu_ns(), walk.ns(model));
  EXPECT_DOUBLE_EQ(cost.read_ns, walk.read_ns(model));
  model.read_gb_per_s = model.ns_per_read = 0.0;
  EXPECT_EQ(walk.read_ns(model), 0.0) << "older results have no price for it";
}

TEST(FrameCost, of_two_the_ratio_goes_as_far_as_prices_do) {
  const FrameCost uploads{{}, 10.0, 0.0, 0.0, 0.0}, loops{{}, 0.0, 0.0, 0.0, 30.0};
  EXPECT_EQ(ratio_by_prices(loops, uploads).low, 0.75);
  EXPECT_EQ(ratio_by_prices(loops, uploads).high, 12.0);
  EXPECT_TRUE(turns_with_prices(uploads, loops));
  const FrameCost timed{20.0, 10.0, 0.0, 0.0, 0.0}, twice{60.0, 10.0, 0.0, 0.0, 0.0};
  EXPECT_EQ(ratio_by_prices(twice, timed).low, 80.0 / 40.0) << "a time has no price";
  EXPECT_EQ(ratio_by_prices(twice, timed).high, 65.0 / 25.0);
  EXPECT_FALSE(turns_with_prices(timed, twice));
}

TEST(FrameCost, without_times_is_what_the_gpu_does) {
  const FrameCost cost = frame_cost({1.0, 1.0, 1.0}, {}, 3.0, 0.0, {});
  EXPECT_FALSE(cost.frame_ns());
  EXPECT_DOUBLE_EQ(cost.gpu_ns(), 3.0);
}

}  // namespace
}  // namespace clusterbench::measure
