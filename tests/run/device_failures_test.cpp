// A device that fails in the middle of a run, before it, or not at all: what is measured all the same, and its
// progress.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "gpu/failing_method.h"
#include "run/estimate.h"
#include "run/runner.h"

namespace clusterbench::run {
namespace {

using gpu::testing::FailingMethod;

struct DeviceRun {
  config::Config config;
  Plan plan;

  explicit DeviceRun(const std::string& assigners, const std::string& more = "")
      : config(config::parse_config(
            R"({"scenes": [{"rig": {"lights": 40, "range": 20}}],
            "grids": [{"tiles": {"count": [5, 4]}, "slices": {"count": 6, "near": 0.1, "far": 60}}],
            "timing": {"sweep_mib": 4, "rounds": 4, "min_time_ms": 0.01, "frames": 1}, "assigners": )" +
                assigners + more + "}",
            "c.json")),
        plan(make_plan(config, "")) {}

  Result result(const Listener& listener = {}, std::span<const GroupCost> costs = {}) const {
    const std::atomic<bool> stop{false};
    return run_plan(config, plan, {}, listener, stop, {}, {}, costs);
  }
};

TEST(DeviceFailures, in_an_estimate_leave_the_time_of_the_other_methods) {
  const assign::AssignerRegistration registration(gpu::testing::failing_method());
  const DeviceRun both(R"(["aabb", "fails"])"), alone(R"(["fails"])");
  FailingMethod::fail_after(0);
  const std::vector<GroupCost> costs = estimated_costs(both.config, both.plan);
  ASSERT_EQ(costs.size(), 1u);
  EXPECT_GT(costs[0].counting_ns, 0.0);
  EXPECT_GT(costs[0].timing_ns, 0.0);
  EXPECT_EQ(costs[0].device_ns, 0.0);
  EXPECT_EQ(estimated_s(alone.config, alone.plan), 0.0);
}

TEST(DeviceFailures, in_a_run_of_several_groups_end_only_what_comes_after_them) {
  const assign::AssignerRegistration registration(gpu::testing::failing_method());
  const DeviceRun two(R"(["aabb", "fails"])", R"(, "viewports": [[160, 90], [320, 180]])");
  ASSERT_EQ(two.plan.case_count(), 4u);
  FailingMethod::fail_after(1'000'000);
  EXPECT_EQ(two.result().cases.size(), 4u);
  const int of_one = FailingMethod::frames_done / 2;
  FailingMethod::fail_after(of_one + 1);
  const Result cut = two.result();
  EXPECT_EQ(cut.cases.size(), 3u);
  ASSERT_EQ(cut.skipped.size(), 1u);
  EXPECT_EQ(cut.skipped[0].reason, "the device was lost");
  FailingMethod::fail_after(of_one + 1, 1);
  EXPECT_EQ(two.result().cases.size(), 4u) << "a device that works again measures the rest";
}

// Progress that never ends, or that is over before its time, is none.
double share_done(const DeviceRun& run, std::span<const GroupCost> costs = {}) {
  Progress last;
  Listener listener;
  listener.on_progress = [&](const Progress& now) {
    EXPECT_LE(now.cost_done, now.cost_total * 1.0001) << now.doing;
    last = now;
  };
  run.result(listener, costs);
  return last.cost_done / last.cost_total;
}

TEST(DeviceFailures, and_devices_that_work_leave_no_progress_undone) {
  const assign::AssignerRegistration registration(gpu::testing::failing_method());
  const DeviceRun both(R"(["aabb", "fails"])");
  FailingMethod::fail_after(1'000'000);
  EXPECT_NEAR(share_done(both), 1.0, 1e-6);
  EXPECT_NEAR(share_done(both, estimated_costs(both.config, both.plan)), 1.0, 1e-6);
  FailingMethod::fail_after(1);
  EXPECT_NEAR(share_done(both), 1.0, 1e-6) << "after a failure";
}

TEST(DeviceFailures, or_not_rounds_on_the_device_take_time_in_an_estimate) {
  const assign::AssignerRegistration registration(gpu::testing::failing_method());
  FailingMethod::fail_after(1'000'000'000);
  const DeviceRun few(R"(["fails"])"), many(R"(["fails"])", R"(, "limits": {"memory_mib": 4096})");
  const std::vector<GroupCost> of_few = estimated_costs(few.config, few.plan);
  EXPECT_EQ(of_few[0].timing_ns, 0.0) << "nothing is timed by the processor's clock";
  EXPECT_GT(of_few[0].device_ns, 0.0);
  EXPECT_EQ(sum_of_timing_s(of_few), 1e-9 * of_few[0].device_ns);
  EXPECT_EQ(sum_s(of_few), 1e-9 * (of_few[0].counting_ns + of_few[0].device_ns));
  config::Config longer = many.config;
  longer.timing.rounds = 1'000'000'000;
  EXPECT_GT(estimated_costs(longer, many.plan)[0].device_ns, 50.0 * of_few[0].device_ns)
      << "far more than it takes to open the device";
  config::Config counted = few.config;
  counted.timing.measure = false;
  EXPECT_EQ(estimated_costs(counted, few.plan)[0].device_ns, 0.0);
}

TEST(DeviceFailures, or_not_progress_tells_each_round_on_the_device) {
  const assign::AssignerRegistration registration(gpu::testing::failing_method());
  FailingMethod::fail_after(1'000'000);
  const DeviceRun run(R"(["fails"])");
  int rounds = 0;
  double cost = 0.0, before = 0.0;
  Listener listener;
  listener.on_progress = [&](const Progress& now) {
    if (now.doing.ends_with("time on the device")) {
      ++rounds;
      cost += now.cost_done - before;
    }
    before = now.cost_done;
  };
  run.result(listener);
  EXPECT_EQ(rounds, 4);
  EXPECT_GT(cost, 0.0);
}

}  // namespace
}  // namespace clusterbench::run
