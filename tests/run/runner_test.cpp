#include "run/runner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/libraries.h"
#include "run/findings/gate.h"
#include "run/walk.h"

namespace clusterbench::run {
namespace {

using testing::k_shafts;
using testing::Walk;

// One tile: a ball on the camera's axis is in every slice that its depths [d - r, d + r] meet.
std::uint64_t slices_met(double depth, double range_m) {
  constexpr double k_bounds[] = {0.5, 2, 4, 8, 16, 32, 64};
  std::uint64_t count = 0;
  for (int slice = 0; slice < 6; ++slice)
    count += depth + range_m >= k_bounds[slice] && depth - range_m <= k_bounds[slice + 1] ? 1 : 0;
  return count;
}

TEST(Runner, counts_of_balls_on_the_axis_are_those_of_their_depth_intervals) {
  Walk walk(std::string(k_shafts) + R"(, "assigners": ["aabb", "brute-force"])");
  constexpr double k_lights[][2] = {{10.3, 2.1}, {5.1, 4.4}, {40.7, 3.3}, {3.0, 0.2}, {90.0, 1.0}};
  for (const auto& [depth, range_m] : k_lights) walk.add_light({0.0, 0.0, -depth}, range_m);
  std::uint64_t pairs = 0;
  std::vector<std::uint64_t> per_frame;
  for (int frame = 0; frame < 3; ++frame) {
    per_frame.push_back(0);
    for (const auto& [depth, range_m] : k_lights) per_frame.back() += slices_met(depth - frame, range_m);
    pairs += per_frame.back();
  }

  const Result result = walk.run();
  ASSERT_EQ(result.cases.size(), 2u);
  for (const CaseResult& case_result : result.cases) {
    ASSERT_TRUE(case_result.error);
    EXPECT_EQ(case_result.frames, 3);
    EXPECT_EQ(case_result.error->frames_checked, 3);
    EXPECT_EQ(case_result.error->true_pairs, pairs);
    EXPECT_EQ(case_result.error->reported_pairs, pairs);
    EXPECT_EQ(case_result.error->false_negatives, 0u);
    EXPECT_EQ(case_result.occupancy->pairs.mean, static_cast<double>(pairs) / 3.0);
    EXPECT_EQ(case_result.buffers.index_entries.high_water, *std::max_element(per_frame.begin(), per_frame.end()));
    EXPECT_EQ(case_result.shading->samples, 3u * 1024u);
    EXPECT_EQ(case_result.shading->missed, 0u);
    EXPECT_FALSE(case_result.timing);
  }
  EXPECT_EQ(result.cases[1].tests_done, 3u * 6u * 5u) << "brute force tests every light against every cell";
}

TEST(Runner, counts_on_a_world_grid_are_those_of_boxes_and_balls) {
  Walk walk(
      R"("grids": [{"kind": "world", "cells": [10, 4, 10], "bounds": {"min": [-10, -4, -10], "max": [10, 4, 10]}}],
               "assigners": ["world-grid"])",
      2);
  std::uint64_t pairs = 0;
  for (int i = 0; i < 20; ++i) {
    const Vec3d centre{9.7 * std::sin(i * 1.7), 3.9 * std::sin(i * 2.3), 9.7 * std::sin(i * 3.1)};
    const double range_m = 0.3 + 0.21 * i;
    walk.add_light(centre, range_m);
    for (int z = 0; z < 10; ++z)
      for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 10; ++x) {
          const Vec3d lo{-10.0 + 2 * x, -4.0 + 2 * y, -10.0 + 2 * z};
          pairs += glm::length(glm::clamp(centre, lo, lo + 2.0) - centre) <= range_m ? 1 : 0;
        }
  }
  const CaseResult case_result = walk.run().cases.at(0);
  EXPECT_EQ(case_result.error->true_pairs, 2 * pairs);
  EXPECT_EQ(case_result.error->reported_pairs, 2 * pairs);
}

std::vector<std::uint64_t> counts(const Result& result) {
  std::vector<std::uint64_t> out;
  for (const CaseResult& case_result : result.cases) {
    out.insert(out.end(), case_result.occupancy->histogram.begin(), case_result.occupancy->histogram.end());
    out.insert(out.end(),
               {case_result.error->true_pairs, case_result.error->false_positives, case_result.error->filter_decided,
                case_result.error->exact_decided, case_result.shading->evaluated, case_result.shading->needed,
                case_result.tests_done, case_result.buffers.bytes.high_water, case_result.buffers.scratch_bytes});
  }
  return out;
}

TEST(Runner, counts_do_not_depend_on_the_number_of_threads) {
  const auto run_with = [](int threads) {
    Walk walk(R"("grids": [{"tiles": {"pixels": [10, 10]}, "slices": {"count": 8}}],
                 "assigners": ["aabb", "sphere-refinement"])");
    walk.config.threads = threads;
    for (int i = 0; i < 60; ++i)
      walk.add_light({8 * std::sin(i * 1.3), 6 * std::sin(i * 2.9), -15 + 14 * std::sin(i * 0.7)}, 0.5 + 0.05 * i);
    for (int i = 0; i < 60; i += 2)
      walk.plan.scenes[0].scene.lights[static_cast<std::size_t>(i)].type = scene::LightType::spot;
    return counts(walk.run());
  };
  EXPECT_EQ(run_with(1), run_with(2));
}

Walk timed(const std::string& more) {
  Walk walk(std::string(k_shafts) + ", " + more);
  walk.config.timing = {.measure = true, .rounds = 4, .min_time_ms = 0.01, .frames = 2, .sweep_mib = 4};
  walk.add_light({0, 0, -6}, 3);
  return walk;
}

TEST(Runner, an_assigner_is_timed_once_for_all_its_storages) {
  const Result result = timed(R"("assigners": ["aabb"], "storages": ["packed", "fixed"])").run();
  ASSERT_EQ(result.cases.size(), 2u);
  const TimingResult &packed = *result.cases[0].timing, &fixed = *result.cases[1].timing;
  EXPECT_EQ(packed.assign_ns.samples, fixed.assign_ns.samples);
  EXPECT_NE(packed.convert_ns->samples, fixed.convert_ns->samples);
  EXPECT_EQ(packed.assign_ns.samples.size(), 4u);
  EXPECT_EQ(packed.convert_ns->samples.size(), 4u);
  EXPECT_EQ(packed.build_ns.samples.size(), 4u);
  EXPECT_EQ(packed.frames_timed, 2);
  EXPECT_GT(packed.assign_ns.min, 0.0);
  EXPECT_GT(packed.write_floor_ns, 0.0);
  for (const TimingResult* timing : {&packed, &fixed})
    for (std::size_t round = 0; round < 4; ++round)
      EXPECT_EQ(timing->frame_ns.samples[round], timing->assign_ns.samples[round] + timing->convert_ns->samples[round]);
}

TEST(Runner, pairs_of_a_timing_are_those_of_its_frames) {
  Walk walk = timed(R"("assigners": ["aabb"])");  // 3 frames, of which 2 are timed: the first and the last
  const CaseResult case_result = walk.run().cases.at(0);
  const std::vector<std::uint64_t>& pairs = case_result.occupancy->pairs_along_path.entries();
  ASSERT_EQ(pairs.size(), 3u);
  const double mean = static_cast<double>(pairs[0] + pairs[2]) / 2.0;
  EXPECT_EQ(case_result.timing->pairs_mean, mean);
  EXPECT_EQ(case_result.timing->pairs_max, std::max(pairs[0], pairs[2]));
  EXPECT_EQ(case_result.timing->ns_per_pair, case_result.timing->frame_ns.median / mean);
  EXPECT_EQ(case_result.timing->worst.pairs, pairs[static_cast<std::size_t>(case_result.timing->worst.frame)]);
  EXPECT_EQ(case_result.timing->builds_per_frame, 0.0);
}

TEST(Runner, of_one_timed_frame_the_worst_is_the_mean) {
  Walk walk(std::string(k_shafts) + R"(, "assigners": ["aabb"])", 1);
  walk.config.timing = {.measure = true, .rounds = 3, .min_time_ms = 0.01, .frames = 4, .sweep_mib = 4};
  walk.add_light({0, 0, -6}, 3);
  const TimingResult timing = *walk.run().cases.at(0).timing;
  EXPECT_EQ(timing.worst.ns, timing.frame_ns.median);
}

TEST(Runner, a_grid_that_follows_the_lights_is_built_for_each_frame_even_if_one_is_timed) {
  for (const int frames : {1, 3}) {
    Walk walk(
        R"("grids": [{"tiles": {"count": [4, 4]}, "slices": {"scheme": "fit", "count": 8}}], "assigners": ["aabb"])");
    walk.config.timing = {.measure = true, .rounds = 2, .min_time_ms = 0.01, .frames = frames, .sweep_mib = 4};
    for (int i = 0; i < 10; ++i) walk.add_light({std::sin(i * 2.0), std::cos(i * 3.0), -8.0 - i}, 1.5);
    EXPECT_EQ(walk.run().cases.at(0).timing->builds_per_frame, 1.0) << frames;
  }
}

TEST(Runner, lights_beyond_the_grid_are_unlit_and_named_so) {
  Walk walk(R"("grids": [{"tiles": {"count": [4, 4]}, "slices": {"count": 8, "near": 0.5, "far": 8}}],
               "assigners": ["exact-fast"])");
  walk.add_light({0, 0, -6}, 5);
  walk.add_light({0, 0, -30}, 15);
  const CaseResult case_result = walk.run().cases.at(0);
  EXPECT_EQ(case_result.error->false_negatives, 0u);
  EXPECT_GT(case_result.shading->missed, 0u);
  EXPECT_EQ(case_result.shading->missed_outside, case_result.shading->missed);
  EXPECT_GT(case_result.shading->unlit(), measure::k_most_unlit);
  EXPECT_TRUE(std::isnan(case_result.shading->comparable_overshade()));
  ASSERT_TRUE(case_result.shading->worst);
  EXPECT_GE(3 * case_result.shading->worst->missed, case_result.shading->missed);
  EXPECT_TRUE(case_result.failures.empty()) << "a warning";
  EXPECT_TRUE(loses_lights(case_result));
}

TEST(Runner, assigners_are_compared_with_the_first_pair_by_pair) {
  const Result result = timed(R"("assigners": ["brute-force", "aabb"])").run();
  EXPECT_FALSE(result.cases[0].timing->against_first);
  ASSERT_TRUE(result.cases[1].timing->against_first);
  EXPECT_EQ(result.cases[1].timing->against_first->assigner, "brute-force");
  const auto &own = result.cases[1].timing->frame_ns.samples, &first = result.cases[0].timing->frame_ns.samples;
  EXPECT_EQ(result.cases[1].timing->against_first->ratio.ratio, measure::paired_ratio(own, first, 1).ratio);
}

TEST(Runner, without_a_pair_the_time_per_pair_is_not_a_number) {
  Walk walk = timed(R"("assigners": ["aabb"])");
  walk.plan.scenes[0].scene.lights[0].range_m = 0.0;
  EXPECT_TRUE(std::isnan(walk.run().cases.at(0).timing->ns_per_pair));
}

TEST(Runner, everything_is_counted_before_anything_is_timed) {
  std::vector<std::string> stages;
  Listener listener;
  listener.on_progress = [&](const Progress& now) {
    const std::string stage = now.doing.substr(now.doing.rfind(": ") + 2);
    if (stages.empty() || stages.back() != stage) stages.push_back(stage);
  };
  timed(R"("assigners": ["brute-force", "aabb"])").run(listener);
  EXPECT_EQ(stages, (std::vector<std::string>{"truth and counts", "time"}));
}

TEST(Runner, progress_ends_at_its_estimate_and_tells_every_case) {
  Progress last;
  std::vector<std::string> told;
  Listener listener;
  listener.on_progress = [&](const Progress& now) {
    EXPECT_GE(now.cost_done, last.cost_done);
    last = now;
  };
  listener.on_case = [&](const CaseResult& case_result) { told.push_back(case_result.id); };
  const Walk walk = timed(R"("assigners": ["brute-force", "aabb"])");
  const Result result = walk.run(listener);
  EXPECT_NEAR(last.cost_done / last.cost_total, 1.0, 1e-9);
  EXPECT_EQ(last.cases_total, 2u);
  EXPECT_EQ(told, (std::vector<std::string>{"0-0-0", "0-1-0"}));
  EXPECT_EQ(result.planned_ids, told);
}

TEST(Runner, a_stop_keeps_only_what_is_complete) {
  Walk walk(std::string(k_shafts) + R"(, "assigners": ["aabb"])");
  walk.add_light({0, 0, -6}, 3);
  walk.plan.groups.push_back(walk.plan.groups[0]);
  walk.plan.groups[1].cases[0].id = "second";
  std::atomic<bool> stop{false};
  Listener listener;
  listener.on_case = [&](const CaseResult&) { stop = true; };
  const Result result = run_plan(walk.config, walk.plan, {}, listener, stop);
  ASSERT_EQ(result.cases.size(), 1u);
  EXPECT_EQ(result.cases[0].id, "0-0-0");
  EXPECT_EQ(result.planned_ids.size(), 2u);
}

TEST(Runner, a_stop_between_rounds_gives_up_the_group) {
  const Walk walk = timed(R"("assigners": ["aabb"])");
  std::atomic<bool> stop{false};
  Listener listener;
  listener.on_progress = [&](const Progress& now) { stop = now.doing.ends_with(": time"); };
  EXPECT_TRUE(run_plan(walk.config, walk.plan, {}, listener, stop).cases.empty());
}

TEST(Runner, what_is_done_is_passed_over) {
  Walk walk(std::string(k_shafts) + R"(, "assigners": ["aabb", "brute-force", "planes"])");
  walk.add_light({0, 0, -6}, 3);
  const Result result = walk.run({}, {"0-0-0", "0-2-0"});
  ASSERT_EQ(result.cases.size(), 1u);
  EXPECT_EQ(result.cases[0].id, "0-1-0");
  EXPECT_EQ(result.planned_ids.size(), 3u);
}

TEST(Runner, slices_that_follow_the_lights_count_like_fixed_ones_of_the_same_frame) {
  Walk walk(
      R"("grids": [{"tiles": {"count": [4, 4]}, "slices": {"scheme": "fit", "count": 8}}], "assigners": ["aabb"])");
  for (int i = 0; i < 10; ++i) walk.add_light({std::sin(i * 2.0), std::cos(i * 3.0), -8.0 - i}, 1.5);
  const CaseResult case_result = walk.run().cases.at(0);
  EXPECT_EQ(case_result.error->false_negatives, 0u);
  EXPECT_GT(case_result.error->true_pairs, 0u);
  EXPECT_TRUE(case_result.grid.contains("note"));
}

TEST(Runner, a_grid_that_far_at_most_cuts_does_not_say_that_no_light_lies_beyond) {
  Walk walk(
      R"("grids": [{"tiles": {"count": [4, 4]}, "slices": {"scheme": "exponential", "count": 8, "far_at_most": 20}}],
         "assigners": ["aabb"])");
  for (scene::Shot& shot : walk.plan.scenes[0].paths[0].shots)
    shot.projection.far_m = std::numeric_limits<double>::infinity();
  walk.add_light({0, 0, -50}, 2);
  const std::string cut = walk.run().cases.at(0).grid["note"];
  EXPECT_NE(cut.find("the grid ends at 20 m, its slices' far_at_most"), std::string::npos) << cut;
  walk.config.grids[0].slices.far_at_most_m = 0.0;
  const std::string note = walk.run().cases.at(0).grid["note"];
  EXPECT_NE(note.find("beyond which no light in view reaches, and lists depend on that"), std::string::npos) << note;
  walk.config.grids[0].slices.far_default_m = 700.0;
  const std::string usual = walk.run().cases.at(0).grid["note"];
  EXPECT_NE(usual.find("the camera has no far plane: the grid ends at 700 m, as that of the engine's own cameras"),
            std::string::npos)
      << usual;
}

TEST(Runner, a_grid_is_told_with_the_constants_of_its_lookup) {
  Walk walk(
      R"("grids": [{"tiles": {"pixels": [50, 25]}, "slices": {"scheme": "exponential", "count": 6, "near": 1, "far": 64}}],
               "assigners": ["aabb"])");
  walk.add_light({0, 0, -6}, 3);
  const nlohmann::json grid = walk.run().cases.at(0).grid;
  EXPECT_EQ(grid["cells"], (nlohmann::json{2, 4, 6}));
  EXPECT_EQ(grid["slices"]["lookup"]["form"], "log2");
  EXPECT_EQ(grid["slices"]["boundaries"].size(), 7u);
  // Depth 8 in 1..64 with a slice per octave: slice 3 begins there.
  const double slice =
      3.0 * grid["slices"]["lookup"]["scale"].get<double>() + grid["slices"]["lookup"]["bias"].get<double>();
  EXPECT_NEAR(slice, 3.0, 0.6);
}

TEST(Facts, name_the_tool_and_the_machine) {
  const ToolFacts tool = tool_facts();
  EXPECT_FALSE(tool.version.empty());
  EXPECT_FALSE(tool.git_sha.empty());
  std::vector<std::string> names;
  for (const auto& [name, version] : tool.libraries) {
    names.push_back(name);
    EXPECT_NE(version.find('.'), std::string::npos) << name << " " << version;
  }
  std::vector<std::string> expected = {"boost"};
  if (is_built_in(Library::onetbb)) expected.push_back("tbb");
  if (is_built_in(Library::embree)) expected.push_back("embree");
  if (is_built_in(Library::nlopt)) expected.push_back("nlopt");
  expected.insert(expected.end(), {"glm", "nlohmann_json"});
  EXPECT_EQ(names, expected);
  const MachineFacts machine = machine_facts();
  EXPECT_GT(machine.cores, 0);
  EXPECT_GT(machine.ram_bytes, 0u);
  EXPECT_NE(machine.os.find("Linux"), std::string::npos);
}

}  // namespace
}  // namespace clusterbench::run
