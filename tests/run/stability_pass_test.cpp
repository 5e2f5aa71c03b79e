#include "run/passes/stability_pass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "run/runner.h"
#include "run/walk.h"

namespace clusterbench::run {
namespace {

using testing::k_shafts;
using testing::Walk;

Walk stable(const std::string& settings, int frames = 3) {
  return Walk(settings + R"(, "stability": {"steps": 400})", frames);
}

// How often balls on the axis of one tile enter or leave a slice while the camera moves towards them step by step.
std::uint64_t crossings(const std::vector<glm::dvec2>& depths_and_ranges, int steps) {
  constexpr double k_bounds[] = {0.5, 2, 4, 8, 16, 32, 64};
  std::uint64_t count = 0;
  for (const glm::dvec2& light : depths_and_ranges)
    for (int slice = 0; slice < 6; ++slice) {
      const auto meets = [&](int step) {
        const double depth = light.x - 0.001 * step;
        return depth + light.y >= k_bounds[slice] && depth - light.y <= k_bounds[slice + 1];
      };
      for (int step = 1; step <= steps; ++step) count += meets(step) != meets(step - 1) ? 1 : 0;
    }
  return count;
}

TEST(StabilityPass, changes_along_the_axis_are_the_crossings_of_slice_boundaries) {
  Walk walk = stable(std::string(k_shafts) + R"(, "assigners": ["aabb", "brute-force"])");
  const std::vector<glm::dvec2> lights{{10.3004, 2.1}, {6.1507, 2.0}, {40.7, 8.5003}, {90.0, 1.0}, {4.3003, 0.1}};
  for (const glm::dvec2& light : lights) walk.add_light({0.0, 0.0, -light.x}, light.y);
  const std::uint64_t expected = crossings(lights, 400);
  ASSERT_GE(expected, 4u);
  for (const CaseResult& case_result : walk.run().cases) {
    ASSERT_TRUE(case_result.stability);
    EXPECT_EQ(case_result.stability->truth.steps, 400);
    EXPECT_EQ(case_result.stability->truth.changes, expected);
    EXPECT_EQ(case_result.stability->truth.flickers, 0u);
    EXPECT_EQ(case_result.stability->method, case_result.stability->truth)
        << "on the axis " << case_result.assigner << " is exact";
    EXPECT_NEAR(case_result.stability->step_m, 1e-3, 1e-12);
    EXPECT_EQ(case_result.stability->step_deg, 0.0);
    EXPECT_EQ(case_result.stability->grids, 1);
    EXPECT_EQ(case_result.stability->undecided, 0u);
    EXPECT_FALSE(case_result.stability->is_drift);
  }
}

TEST(StabilityPass, is_left_out_where_nobody_asks_for_it) {
  Walk walk(std::string(k_shafts) + R"(, "assigners": ["aabb"])");
  walk.add_light({0, 0, -6}, 3);
  EXPECT_FALSE(walk.run().cases.at(0).stability);
}

TEST(StabilityPass, needs_no_accuracy_check_for_its_truth) {
  Walk walk = stable(std::string(k_shafts) + R"(, "assigners": ["aabb"], "accuracy": {"check": false})");
  walk.add_light({0, 0, -6.1507}, 2);
  const CaseResult case_result = walk.run().cases.at(0);
  EXPECT_FALSE(case_result.error);
  EXPECT_GT(case_result.stability->truth.changes, 0u);
}

TEST(StabilityPass, a_loose_method_changes_more_than_the_truth) {
  Walk walk = stable(R"("grids": [{"tiles": {"pixels": [10, 10]}}], "assigners": ["bounds"])");
  for (int i = 0; i < 40; ++i)
    walk.add_light({8 * std::sin(i * 1.3), 6 * std::sin(i * 2.9), -15 + 14 * std::sin(i * 0.7)}, 1.0 + 0.05 * i);
  const StabilityResult stability = *walk.run().cases.at(0).stability;
  EXPECT_GT(stability.truth.changes, 40u);
  EXPECT_GT(stability.method.changes, stability.truth.changes);
}

TEST(StabilityPass, lights_that_stand_in_a_world_grid_never_change) {
  Walk walk = stable(R"("grids": [{"kind": "world", "cells": [8, 4, 8]}], "assigners": ["world-grid"])");
  for (int i = 0; i < 10; ++i) walk.add_light({std::sin(i * 2.0), std::cos(i * 3.0), -8.0 - i}, 1.5);
  const StabilityResult stability = *walk.run().cases.at(0).stability;
  EXPECT_EQ(stability.truth, (measure::Churn{.steps = 400}));
  EXPECT_EQ(stability.method, stability.truth);
}

TEST(StabilityPass, a_standing_camera_drifts_and_the_result_says_so) {
  Walk walk = stable(std::string(k_shafts) + R"(, "assigners": ["aabb"])", 1);
  walk.add_light({0, 0, -6.1507}, 2);
  const StabilityResult stability = *walk.run().cases.at(0).stability;
  EXPECT_TRUE(stability.is_drift);
  EXPECT_EQ(stability.method.steps, 400);
  EXPECT_NEAR(stability.step_m, 1e-3, 1e-12);
  EXPECT_NEAR(stability.step_deg, 0.01, 1e-12);
  EXPECT_NE(stability.path.find("drift"), std::string::npos);
  EXPECT_GT(stability.truth.changes, 0u);
}

TEST(StabilityPass, counts_the_grids_of_slices_that_follow_the_lights) {
  Walk walk = stable(
      R"("grids": [{"tiles": {"count": [4, 4]}, "slices": {"scheme": "fit", "count": 8}}], "assigners": ["aabb"])");
  for (int i = 0; i < 10; ++i) walk.add_light({std::sin(i * 2.0), std::cos(i * 3.0), -8.0 - i}, 1.5);
  EXPECT_GT(walk.run().cases.at(0).stability->grids, 1);
}

TEST(StabilityPass, each_case_has_its_assigners_lists_whatever_they_are_stored_in) {
  Walk walk = stable(
      R"("grids": [{"tiles": {"pixels": [10, 10]}}], "assigners": ["bounds", "aabb"], "storages": ["packed", "fixed"])");
  for (int i = 0; i < 10; ++i) walk.add_light({3 * std::sin(i * 2.0), std::cos(i * 3.0), -8.0 - i}, 1.5);
  const Result result = walk.run();
  ASSERT_EQ(result.cases.size(), 4u);
  EXPECT_EQ(result.cases[0].stability->method, result.cases[1].stability->method);
  EXPECT_EQ(result.cases[2].stability->method, result.cases[3].stability->method);
  EXPECT_FALSE(result.cases[0].stability->method == result.cases[2].stability->method);
  EXPECT_EQ(result.cases[0].stability->truth, result.cases[2].stability->truth);
}

TEST(StabilityPass, does_not_depend_on_the_number_of_threads) {
  const auto run_with = [](int threads) {
    Walk walk = stable(R"("grids": [{"tiles": {"pixels": [10, 10]}, "slices": {"count": 8}}],
                          "assigners": ["aabb", "sphere-refinement"])");
    walk.config.threads = threads;
    for (int i = 0; i < 30; ++i)
      walk.add_light({8 * std::sin(i * 1.3), 6 * std::sin(i * 2.9), -15 + 14 * std::sin(i * 0.7)}, 0.5 + 0.05 * i);
    std::vector<measure::Churn> counts;
    for (const CaseResult& case_result : walk.run().cases)
      counts.insert(counts.end(), {case_result.stability->method, case_result.stability->truth});
    return counts;
  };
  EXPECT_EQ(run_with(1), run_with(2));
}

TEST(StabilityPass, progress_ends_at_its_estimate_though_the_path_is_short) {
  Progress last;
  bool is_told = false;
  Listener listener;
  listener.on_progress = [&](const Progress& now) {
    last = now;
    is_told = is_told || now.doing.ends_with(": stability");
  };
  Walk walk(std::string(k_shafts) + R"(, "assigners": ["aabb"], "stability": {"steps": 99, "step_mm": 100})");
  walk.add_light({0, 0, -6}, 3);
  EXPECT_EQ(walk.run(listener).cases.at(0).stability->method.steps, 20);
  EXPECT_TRUE(is_told);
  EXPECT_NEAR(last.cost_done / last.cost_total, 1.0, 1e-9);
}

TEST(StabilityPass, a_stop_between_steps_gives_up_the_group) {
  Walk walk = stable(std::string(k_shafts) + R"(, "assigners": ["aabb"])");
  walk.add_light({0, 0, -6}, 3);
  std::atomic<bool> stop{false};
  Listener listener;
  listener.on_progress = [&](const Progress& now) { stop = now.doing.ends_with(": stability"); };
  EXPECT_TRUE(run_plan(walk.config, walk.plan, {}, listener, stop).cases.empty());
}

TEST(StabilityPass, a_piece_of_a_path_keeps_the_paths_grids) {
  Walk walk(std::string(k_shafts) + R"(, "assigners": ["aabb"])", 30);
  walk.add_light({0, 0, -6}, 3);
  const SceneData& data = walk.plan.scenes[0];
  scene::CameraPath segment = data.paths[0];
  segment.shots.erase(segment.shots.begin(), segment.shots.begin() + 3);  // nearer to the light
  segment.shots.resize(2);
  const PathFrames whole(data.scene, data.paths[0], {100, 100});
  EXPECT_NE(PathFrames(data.scene, segment, {100, 100}).far_m(), whole.far_m());
  EXPECT_EQ(whole.along(segment).far_m(), whole.far_m());
  EXPECT_EQ(whole.along(segment).count(), 2);
}

}  // namespace
}  // namespace clusterbench::run
