#include "run/passes/timing_pass.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "run/counters/machine_load.h"
#include "run/timing/cache_sweep.h"
#include "run/walk.h"

namespace clusterbench::run::testing {
namespace {

// Five frames, of which the first and the last are in the means; a light that the camera walks towards.
Walk timed_walk(const std::string& more) {
  Walk walk(std::string(k_shafts) + ", " + more, 5);
  walk.config.timing = {.measure = true, .rounds = 4, .min_time_ms = 0.01, .frames = 2, .sweep_mib = 4};
  walk.add_light({0, 0, -6}, 3);
  return walk;
}

GroupSamples measured(const Walk& walk, const LaunchRequest& request) {
  const GroupPlan& group = walk.plan.groups[0];
  const SceneData& data = walk.plan.scenes[group.scene];
  const PathFrames path(data.scene, data.paths[0], walk.config.viewports[0]);
  return measure_launch(walk.config, group, path, request, [](int) {}, {false});
}

TEST(TimingPass, caches_are_swept_before_each_frame_that_is_measured_cold) {
  const Walk walk = timed_walk(R"("assigners": ["aabb", "planes"], "storages": ["packed", "fixed"])");
  std::size_t sweeps = 0;
  const GroupSamples samples = measured(walk, {0, 4, {3, 0}, [&] { ++sweeps; }});
  ASSERT_EQ(samples.methods.size(), 2u);
  EXPECT_EQ(sweeps, 4 * 2 * (3 + 2)) << "rounds; each storage by itself; the first method has a further frame";
  for (const MethodSamples& method : samples.methods) {
    EXPECT_EQ(method.cold_each.size(), 4u);
    EXPECT_EQ(method.warm_ns.size(), 4u);
    EXPECT_GE(method.warm_passes, 1);
    EXPECT_GE(method.stores[1].warm_passes, 1);
    EXPECT_TRUE(method.warm_each.empty());
    ASSERT_EQ(method.stores.size(), 2u);
    EXPECT_EQ(method.stores[1].cold_each.size(), 4u);
    EXPECT_EQ(method.stores[1].cold_each[0].size(), method.frames.size());
  }
}

TEST(TimingPass, without_cold_times_nothing_is_swept_and_frames_are_told_apart_warm) {
  Walk walk = timed_walk(R"("assigners": ["aabb"])");
  walk.config.timing.cold = false;
  int sweeps = 0;
  const GroupSamples samples = measured(walk, {0, 2, {3}, [&] { ++sweeps; }});
  EXPECT_EQ(sweeps, 0);
  EXPECT_TRUE(samples.methods[0].cold_each.empty());
  EXPECT_EQ(samples.methods[0].warm_each.size(), 2u);
  const TimingResult timing = timing_results(walk.config, walk.plan.groups[0], std::span(&samples, 1))[0];
  EXPECT_FALSE(timing.is_cold);
  EXPECT_FALSE(timing.warm);
  EXPECT_GT(timing.frame_ns.median, 0.0);
}

TEST(TimingPass, warm_rounds_can_be_fewer_where_caches_are_cold) {
  Walk walk = timed_walk(R"("assigners": ["aabb"])");
  const LaunchRequest request{0, 4, {}, [] {}, 1};
  const GroupSamples cold = measured(walk, request);
  EXPECT_EQ(cold.methods[0].warm_ns.size(), 1u);
  EXPECT_EQ(cold.methods[0].cold_each.size(), 4u);
  const TimingResult timing = timing_results(walk.config, walk.plan.groups[0], std::span(&cold, 1))[0];
  EXPECT_EQ(timing.frame_ns.samples.size(), 4u);
  EXPECT_EQ(timing.warm->frame_ns.samples.size(), 1u);
  walk.config.timing.cold = false;
  EXPECT_EQ(measured(walk, request).methods[0].warm_ns.size(), 4u) << "there is nothing else";
}

TEST(TimingPass, the_frame_with_most_pairs_is_timed_beside_those_of_the_means) {
  const Walk walk = timed_walk(R"("assigners": ["aabb"])");
  const GroupSamples samples = measured(walk, {0, 1, {2}});
  const MethodSamples& method = samples.methods.at(0);
  EXPECT_EQ(method.frames, (std::vector<int>{0, 4, 2}));
  EXPECT_EQ(method.mean_frames, 2u);
  EXPECT_EQ(method.pairs.size(), 3u);
  EXPECT_EQ(measured(walk, {0, 1, {4}}).methods[0].frames, (std::vector<int>{0, 4}));
  EXPECT_EQ(measured(walk, {0, 1, {-1}}).methods[0].frames, (std::vector<int>{0, 4}));
}

// One method of three frames, the last of which is not in the means.
GroupSamples by_hand(double assign_ns, double convert_ns, int assign_passes = 7, int convert_passes = 80) {
  MethodSamples method;
  method.warm_passes = assign_passes;
  method.frames = {0, 4, 2};
  method.mean_frames = 2;
  method.pairs = {10, 30, 70};
  for (int round = 0; round < 2; ++round) {
    method.build_ns.push_back(1.0);
    method.floor_ns.push_back(1.0);
    method.warm_ns.push_back(0.5 * assign_ns);
    method.cold_each.push_back({0.9 * assign_ns, 1.1 * assign_ns, 3.0 * assign_ns});
  }
  method.stores.push_back(
      {{convert_ns, convert_ns}, {}, {{convert_ns, convert_ns, convert_ns}, {0, 2 * convert_ns, 0}}, convert_passes});
  return {{method}, {10.0, 5.0, 1.0, 2}};
}

TEST(TimingPass, means_are_of_their_frames_and_the_worst_is_of_all) {
  const Walk walk = timed_walk(R"("assigners": ["aabb"])");
  const GroupSamples samples = by_hand(1000.0, 100.0);
  const TimingResult timing = timing_results(walk.config, walk.plan.groups[0], std::span(&samples, 1)).at(0);
  EXPECT_TRUE(timing.is_cold);
  EXPECT_NEAR(timing.assign_ns.median, 1000.0, 1e-9);
  EXPECT_NEAR(timing.convert_ns->median, 100.0, 1e-9);
  EXPECT_NEAR(timing.frame_ns.median, 1100.0, 1e-9);
  EXPECT_NEAR(timing.warm->assign_ns.median, 500.0, 1e-9);
  EXPECT_NEAR(timing.warm->frame_ns.median, 600.0, 1e-9);
  EXPECT_EQ(timing.pairs_mean, 20.0);
  EXPECT_EQ(timing.worst.frame, 2);
  EXPECT_NEAR(timing.worst.ns, 3050.0, 1e-9);  // of two rounds, 3100 and 3000
  EXPECT_EQ(timing.worst.pairs, 70u);
  EXPECT_EQ(timing.frames_timed, 2);
}

TEST(TimingPass, passes_of_a_sample_are_those_of_the_launch_with_fewest) {
  const Walk walk = timed_walk(R"("assigners": ["aabb"])");
  const std::vector<GroupSamples> launches{by_hand(1000.0, 10.0, 7, 80), by_hand(1000.0, 10.0, 5, 90)};
  const TimingResult timing = timing_results(walk.config, walk.plan.groups[0], launches).at(0);
  EXPECT_EQ(timing.warm_assign_passes, 5);
  EXPECT_EQ(timing.warm_convert_passes, 80);
}

TEST(TimingPass, of_several_launches_intervals_are_between_them) {
  const Walk walk = timed_walk(R"("assigners": ["aabb"])");
  const std::vector<GroupSamples> launches{by_hand(1000.0, 0.0), by_hand(1100.0, 0.0), by_hand(900.0, 0.0)};
  const TimingResult timing = timing_results(walk.config, walk.plan.groups[0], launches).at(0);
  EXPECT_EQ(timing.launches, 3);
  EXPECT_EQ(timing.frame_ns.samples.size(), 6u);
  EXPECT_LT(timing.frame_ns.ci95.low, 800.0) << "Student's t of two degrees of freedom, not the bootstrap's 900";
  EXPECT_GT(timing.frame_ns.ci95.high, 1200.0);
  EXPECT_EQ(timing.disturbance.seconds, 30.0);
  EXPECT_EQ(timing.disturbance.throttled, 6u);
}

TEST(TimingPass, a_launcher_is_asked_for_each_launch_and_its_cases_wait_for_the_last) {
  Walk walk = timed_walk(R"("assigners": ["aabb"])");
  walk.config.timing.launches = 3;
  std::vector<std::pair<int, int>> asked;
  std::vector<int> fullest;
  std::vector<std::string> told;
  Listener listener;
  listener.on_case = [&](const CaseResult& case_result) { told.push_back(case_result.id); };
  const Launcher launcher = [&](std::span<const GroupToTime> groups, int launch, int rounds,
                                const std::function<void(std::size_t)>& on_group) {
    EXPECT_TRUE(told.empty());
    EXPECT_EQ(groups.size(), 1u);
    on_group(0);
    asked.emplace_back(launch, rounds);
    fullest = groups[0].fullest_frames;
    return std::vector<GroupSamples>{by_hand(1000.0 + launch, 0.0)};
  };
  const std::atomic<bool> stop{false};
  const Result result = run_plan(walk.config, walk.plan, {}, listener, stop, {}, launcher);
  EXPECT_EQ(asked, (std::vector<std::pair<int, int>>{{0, 2}, {1, 2}, {2, 2}})) << "4 rounds in 3 launches";
  EXPECT_EQ(told.size(), 1u);
  ASSERT_EQ(result.cases.size(), 1u);
  EXPECT_EQ(result.cases[0].timing->launches, 3);
  const std::vector<std::uint64_t>& pairs = result.cases[0].occupancy->pairs_along_path.entries();
  ASSERT_EQ(fullest.size(), 1u);
  EXPECT_EQ(fullest[0], std::max_element(pairs.begin(), pairs.end()) - pairs.begin());
}

TEST(TimingPass, neighbours_change_and_each_order_is_followed_by_its_reverse) {
  std::set<std::vector<std::size_t>> orders;
  for (int launch = 0; launch < 3; ++launch)
    for (int round = 0; round < 6; round += 2) {
      std::vector<std::size_t> order = method_order(8, 1, launch, round);
      orders.insert(order);
      std::reverse(order.begin(), order.end());
      EXPECT_EQ(method_order(8, 1, launch, round + 1), order);
      std::sort(order.begin(), order.end());
      EXPECT_EQ(order, (std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6, 7}));
    }
  EXPECT_EQ(orders.size(), 9u);
  EXPECT_EQ(method_order(8, 1, 2, 4), method_order(8, 1, 2, 4));
  EXPECT_NE(method_order(8, 1, 0, 0), method_order(8, 2, 0, 0));
}

TEST(TimingPass, cold_rounds_sweep_for_no_longer_than_some_time_and_are_never_none) {
  EXPECT_EQ(cold_rounds(3, 5, 40 << 20), 3);
  EXPECT_EQ(cold_rounds(100, 5, 400 << 20), 1);
  EXPECT_EQ(cold_rounds(31, 1000, 1 << 30), 1);
  const int many = cold_rounds(100, 5, 40 << 20);
  EXPECT_LT(many, 20);
  EXPECT_GE(many, 3);
}

TEST(TimingPass, a_sweep_is_larger_than_the_caches_of_the_machine_or_as_much_as_a_frame_writes) {
  std::uint64_t largest = 0;
  for (const auto& [name, bytes] : machine_facts().caches) largest = std::max(largest, bytes);
  EXPECT_GT(sweep_bytes({}), std::min<std::uint64_t>(largest, 255 << 20));
  EXPECT_LE(sweep_bytes({}), 256u << 20);
  EXPECT_EQ(sweep_bytes(64), 64u << 20) << "a user's";
}

TEST(MachineLoad, is_read_from_the_first_line_of_proc_stat) {
  std::istringstream stat("cpu  300 0 100 5000 7 0 50 25 0 0\ncpu0 1 1 1 1 1 1 1 1\n");
  const os::ProcessorTime time = os::processor_time(stat);
  const auto ticks = static_cast<double>(sysconf(_SC_CLK_TCK));
  EXPECT_DOUBLE_EQ(time.busy_s, 450.0 / ticks);
  EXPECT_DOUBLE_EQ(time.stolen_s, 25.0 / ticks);
  std::istringstream other("nothing of the kind");
  EXPECT_EQ(os::processor_time(other).busy_s, 0.0);
}

}  // namespace
}  // namespace clusterbench::run::testing
