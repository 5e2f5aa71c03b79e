// How many frames a run takes, and which grids are held against the truth, where it is to end soon.

#include "run/cases/frame_work.h"

#include <gtest/gtest.h>

#include "config/presets/preset_library.h"
#include "places.h"
#include "run/findings/gate.h"
#include "run/scene_facts.h"
#include "run/walk.h"

namespace clusterbench::run::testing {
namespace {

TEST(FrameWork, a_point_is_reached_by_the_lights_that_cover_the_whole_view) {
  Walk walk(k_shafts, 5);
  for (int i = 0; i < 3; ++i) walk.add_light({0, 0, -1.0 * i}, 500);
  walk.add_light({0, 0, 900}, 1);
  EXPECT_DOUBLE_EQ(lights_at_a_point(path_of(walk.config, walk.plan, walk.plan.groups[0]), 1), 3.0);
}

TEST(FrameWork, frames_are_fewer_where_many_lights_reach_a_point_and_a_few_in_any_case) {
  const Walk walk(k_shafts, 30);
  const std::vector<scene::CameraPath>& paths = walk.plan.scenes[0].paths;
  EXPECT_EQ(frames_within(30, 1200, paths, std::vector{40.0}), 30);
  EXPECT_EQ(frames_within(30, 1200, paths, std::vector{80.0}), 15);
  EXPECT_EQ(frames_within(30, 1200, paths, std::vector{5000.0}), 6);
  EXPECT_EQ(frames_within(4, 1200, paths, std::vector{5000.0}), 4);
  EXPECT_EQ(frames_within(30, 1200, paths, std::vector{0.0}), 30);
}

config::Config street(const std::string& rest, const std::string& frames) {
  return config::parse_config(
      R"({"scenes": [{"path": ")" + test::source_dir() + R"(/scenes/street.glb", "frames": )" + frames +
          R"(}], "viewport": [320, 180], "timing": {"measure": false}, "shading": {"samples": 512})" + rest + "}",
      "c.json");
}

Result counted(const config::Config& config, const Plan& plan) {
  const std::atomic<bool> stop{false};
  return run_plan(config, plan, {}, {}, stop);
}

TEST(FrameWork, fewer_frames_are_told_and_are_the_same_cases_as_so_many_asked_for) {
  const config::Config few = street(R"(, "assigners": ["aabb"])", R"({"most": 30, "lights": 1})");
  const Plan plan = make_plan(few, "");
  EXPECT_EQ(plan.scenes[0].paths[0].shots.size(), 6u);
  const std::string told = fewer_frames(plan.scenes[0]);
  EXPECT_TRUE(told.starts_with("measured in 6 frames and not in 30")) << told;
  EXPECT_NE(told.find("--set 'scenes.*.frames=30'"), std::string::npos) << told;
  EXPECT_EQ(scene_result(plan.scenes[0], few.scenes[0], few.viewports, 1).warnings.back(), told);
  const Plan six = make_plan(street(R"(, "assigners": ["aabb"])", "6"), "");
  EXPECT_EQ(plan.groups[0].cases[0].id, six.groups[0].cases[0].id);
  const Plan all = make_plan(street(R"(, "assigners": ["aabb"])", R"({"most": 30, "lights": 1e6})"), "");
  EXPECT_EQ(all.scenes[0].paths[0].shots.size(), 30u);
  EXPECT_EQ(fewer_frames(all.scenes[0]), "");
}

constexpr const char* k_two_grids = R"(, "grids": [
    {"kind": "frustum", "tiles": {"pixels": [64, 64]}, "slices": {"scheme": "exponential", "count": 8}},
    {"kind": "frustum", "tiles": {"pixels": [4, 4]}, "slices": {"scheme": "exponential", "count": 64}}],
    "assigners": ["aabb", "z-binning"])";

TEST(FrameWork, of_a_grid_with_too_many_cells_samples_decide_and_the_result_says_so) {
  const config::Config config = street(std::string(k_two_grids) + R"(, "accuracy": {"most_pairs": 50000})", "2");
  const Plan plan = make_plan(config, "");
  const Result result = counted(config, plan);
  ASSERT_EQ(result.cases.size(), 4u);
  int large = 0;
  for (const CaseResult& one : result.cases) {
    const bool is_large = one.grid["cells"][2] == 64;
    large += is_large ? 1 : 0;
    EXPECT_EQ(one.cells_not_compared, is_large ? 80u * 45u * 64u : 0u) << one.name;
    EXPECT_EQ(one.error.has_value(), !is_large) << one.name;
    EXPECT_EQ(one.occupancy.has_value(), !is_large || one.storage_label == "packed") << one.name;
    EXPECT_GT(one.shading->needed, 0u);
    EXPECT_TRUE(one.failures.empty()) << one.name << ": " << one.failures[0].text;
  }
  EXPECT_EQ(large, 2);
}

TEST(FrameWork, a_configuration_that_asks_for_the_comparison_gets_all_of_it) {
  for (const char* accuracy : {"", R"(, "accuracy": {"check": true})"}) {
    const config::Config config = street(std::string(k_two_grids) + accuracy, "1");
    for (const CaseResult& one : counted(config, make_plan(config, "")).cases) {
      EXPECT_EQ(one.cells_not_compared, 0u);
      EXPECT_TRUE(one.error.has_value()) << one.name;
    }
  }
}

TEST(FrameWork, a_method_that_may_lose_no_light_fails_by_its_samples_where_cells_are_not_compared) {
  const config::Config config = street(std::string(k_two_grids) + R"(, "accuracy": {"most_pairs": 50000})", "2");
  const Result result = counted(config, make_plan(config, ""));
  for (CaseResult one : result.cases) {
    if (one.cells_not_compared == 0) continue;
    one.shading->missed = one.shading->needed / 100;
    one.shading->missed_outside = 0;
    const std::vector<Failure> failures = failures_of(one, config.limits);
    ASSERT_EQ(failures.size(), 1u) << one.name;
    EXPECT_EQ(failures[0].kind, Failure::Kind::lost_at_samples);
    EXPECT_TRUE(loses_lights(one));
  }
}

TEST(FrameWork, presets_of_engines_that_assign_on_a_gpu_are_not_timed) {
  config::Config config = street(R"(, "presets": ["doom-2016", "three-js", "godot"])", "2");
  config.timing = {.measure = true, .rounds = 2, .min_time_ms = 0.1, .frames = 1, .launches = 1, .cold = false};
  const Result result = counted(config, make_plan(config, ""));
  ASSERT_EQ(result.cases.size(), 3u);
  for (const CaseResult& one : result.cases)
    EXPECT_EQ(one.timing.has_value(), config::find_preset(one.preset)->assigns_on == "cpu") << one.name;
}

}  // namespace
}  // namespace clusterbench::run::testing
