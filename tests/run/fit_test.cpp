// Slices that follow what frames need, along a path.

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/random.h"
#include "needs.h"
#include "places.h"
#include "run/cases/path_frames.h"
#include "run/passes/timing_pass.h"
#include "run/walk.h"

namespace clusterbench::run {
namespace {

using testing::Walk;

std::string following(const std::string& fit, const std::string& scheme = "exponential") {
  return R"("grids": [{"tiles": {"count": [4, 4]}, "slices": {"scheme": ")" + scheme +
         R"(", "count": 8, "near": 0.5, "far": 64)" +
         (scheme == "exponential-first" ? std::string(R"(, "first": 2)") : std::string()) +
         (fit.empty() ? std::string() : R"(, "fit": )" + fit) + R"(}}], "assigners": ["aabb", "exact"])";
}

// Lights in three clumps that the camera walks through, so that the span that they need jumps.
void add_clumps(Walk& walk) {
  SplitMix64 random(3);
  for (const double depth : {6.0, 14.0, 30.0})
    for (int i = 0; i < 12; ++i) {
      const double x = random.between(-2.0, 2.0), y = random.between(-2.0, 2.0);
      walk.add_light({x, y, -depth - random.between(-1.0, 1.0)}, random.between(0.3, 1.2));
    }
}

Result run_following(const std::string& fit, const std::string& scheme = "exponential", int frames = 40) {
  Walk walk(following(fit, scheme), frames);
  add_clumps(walk);
  return walk.run();
}

const EvaluatedLights& in_view(const CaseSide& side) {
  return side.evaluated.front();
}

TEST(FittedSlicesOnAPath, lose_no_light_and_save_pairs_entries_and_evaluated_lights) {
  for (const char* scheme : {"linear", "exponential", "exponential-first", "power"})
    for (const char* fit : {"{}", R"({"damping": 0.9})", R"({"step": 1.25})", R"({"damping": 0.5, "step": 2})"}) {
      const Result result = run_following(fit, scheme);
      for (const CaseResult& found : result.cases) {
        ASSERT_TRUE(found.fit);
        EXPECT_TRUE(found.failures.empty());
        EXPECT_EQ(found.error->false_negatives, 0u);
        EXPECT_EQ(in_view(found.fit->fitted).missed, 0u) << scheme << " " << fit;
        EXPECT_LT(in_view(found.fit->fitted).evaluated, in_view(found.fit->unfitted).evaluated) << scheme << fit;
      }
    }
}

TEST(FittedSlicesOnAPath, are_compared_with_the_same_case_without_fit) {
  const Result plain = run_following(""), fitted = run_following(R"({"damping": 0.5})");
  for (std::size_t i = 0; i < plain.cases.size(); ++i) {
    EXPECT_FALSE(plain.cases[i].fit);
    const CaseSide& unfitted = fitted.cases[i].fit->unfitted;
    EXPECT_EQ(unfitted.pairs_mean, plain.cases[i].occupancy->pairs.mean);
    EXPECT_EQ(unfitted.true_pairs, plain.cases[i].error->true_pairs);
    EXPECT_EQ(unfitted.false_positives, plain.cases[i].error->false_positives);
    EXPECT_EQ(unfitted.index_entries, plain.cases[i].buffers.index_entries.high_water);
    EXPECT_EQ(unfitted.bytes, plain.cases[i].buffers.bytes.high_water);
    EXPECT_EQ(in_view(unfitted).evaluated, plain.cases[i].shading->evaluated);
    EXPECT_EQ(fitted.cases[i].fit->fitted.pairs_mean, fitted.cases[i].occupancy->pairs.mean);
  }
}

TEST(FittedSlicesOnAPath, move_less_with_damping_and_change_less_often_with_steps) {
  const auto moves = [](const std::string& fit) { return run_following(fit).cases.front().fit->moves; };
  const GridMoves at_once = moves("{}"), damped = moves(R"({"damping": 0.9})"), stepped = moves(R"({"step": 1.5})");
  EXPECT_EQ(at_once.steps, 39);
  EXPECT_GT(at_once.moved.sum, 0.0);
  EXPECT_LT(damped.moved.sum, at_once.moved.sum);
  EXPECT_LT(damped.moved.greatest, at_once.moved.greatest);
  EXPECT_LT(stepped.changed, at_once.changed);
  EXPECT_LT(stepped.cells_changed, at_once.cells_changed);
}

TEST(FittedSlicesOnAPath, are_the_same_whichever_frames_are_asked_for) {
  Walk walk(following(R"({"damping": 0.8, "step": 1.25})"), 30);
  add_clumps(walk);
  const grid::GridSpec& spec = walk.config.grids[0];
  const PathFrames all = path_of(walk.config, walk.plan, walk.plan.groups[0]),
                   some = path_of(walk.config, walk.plan, walk.plan.groups[0]);
  std::vector<grid::GridInputs> in_order;
  for (int i = 0; i < all.count(); ++i) in_order.push_back(all.inputs(spec, all.frame(i)));
  for (const int i : {29, 3, 17, 0})
    EXPECT_EQ(some.inputs(spec, some.frame(i)), in_order[static_cast<std::size_t>(i)]) << i;
  grid::SpanFollower follower(*spec.slices.fit);
  for (int i = 0; i < all.count(); ++i) {
    const grid::Span needed = all.needed(spec, all.frame(i));
    EXPECT_EQ(in_order[static_cast<std::size_t>(i)].needed, follower.next(needed));
    if (needed.is_empty()) continue;
    EXPECT_LE(in_order[static_cast<std::size_t>(i)].needed.near_m, needed.near_m);
    EXPECT_GE(in_order[static_cast<std::size_t>(i)].needed.far_m, needed.far_m);
  }
}

TEST(FittedSlicesOnAPath, are_timed_beside_the_slices_that_do_not_follow) {
  Walk walk(following("{}"), 6);
  add_clumps(walk);
  const std::atomic<bool> stop{false};
  walk.config.timing.min_time_ms = 0.01;
  walk.config.timing.cold = false;
  const GroupPlan& group = walk.plan.groups[0];
  const PathFrames path = path_of(walk.config, walk.plan, group);
  const std::vector<GroupSamples> launches{measure_launch(
      walk.config, group, path, {0, 3, {0, 1, 2, 3, 4, 5}, {}}, [](int) {}, stop)};
  EXPECT_EQ(launches[0].methods.size(), 4u) << "two methods, in two grids each";
  EXPECT_EQ(launches[0].follow_ns.size(), 3u);
  for (const TimingResult& timing : timing_results(walk.config, group, launches)) {
    ASSERT_TRUE(timing.fit);
    EXPECT_EQ(timing.fit->unfitted_ns.samples.size(), 3u);
    EXPECT_GT(timing.fit->follow_ns.median, 0.0);
    EXPECT_GT(timing.builds_per_frame, 0.5) << "a new grid in most frames";
  }
  EXPECT_LT(launches[0].methods[2].builds_per_frame, 0.5) << "the other grid stays";
}

TEST(FittedSlicesOnAPath, that_follow_surfaces_take_a_scene_with_triangles) {
  config::Config config = config::parse_config(
      R"({"scenes": [{"rig": {"lights": 10}}], "timing": {"measure": false}, "assigners": ["aabb"],
          "grids": [{"slices": {"far": 100, "fit": [null, {"to": "surfaces"}]}}]})",
      "c.json");
  const Plan plan = make_plan(config, "");
  ASSERT_EQ(plan.groups.size(), 1u);
  ASSERT_EQ(plan.skipped.size(), 1u);
  EXPECT_EQ(plan.skipped[0].reason, "slices that follow surfaces need a depth buffer, and the scene has no triangles");
}

TEST(FittedSlicesOnAPath, that_follow_surfaces_hold_every_visible_one) {
  NEEDS(embree);
  config::Config config = config::parse_config(
      R"({"scenes": [{"path": "scenes/steps.glb", "frames": 3}], "viewport": [160, 90], "timing": {"measure": false},
          "assigners": ["exact-fast", "distance-fast"], "samples": {"opaque": {"divisor": 1}}, "shading": {"samples": 0},
          "grids": [{"slices": {"far": 400, "fit": {"to": ["surfaces", "both"]}}},
                    {"kind": "distance", "slices": {"far": 500, "fit": {"to": ["surfaces", "both"]}}}]})",
      test::source_dir() + "/c.json");
  const Plan plan = make_plan(config, "");
  const std::atomic<bool> stop{false};
  const Result result = run_plan(config, plan, {}, {}, stop);
  ASSERT_EQ(result.cases.size(), 4u);
  for (const CaseResult& found : result.cases) {
    ASSERT_FALSE(found.samples.empty());
    EXPECT_EQ(found.samples.front().counts.missed, 0u) << found.name;
    EXPECT_GT(found.samples.front().counts.needed, 0u);
    EXPECT_LE(found.fit->moves.far_m.greatest, found.fit->range.far_m);
  }
}

// configs/fit.json in a small picture, without times.
TEST(ConfigsFit, shows_that_following_saves_looping_that_damping_calms_and_that_cubical_cells_are_cubical) {
  const config::FlagValue flags[] = {
      {"--viewport", "320x180"}, {"--assigner", "aabb-fast,exact-fast"}, {"--set", "timing.measure=false"}};
  const config::Config config =
      config::load_config(std::filesystem::path(test::source_dir()) / "configs/fit.json", flags);
  const std::atomic<bool> stop{false};
  const Result result = run_plan(config, make_plan(config, ""), {}, {}, stop);
  double moved_at_once = 0.0, moved_damped = 0.0;
  int fitted = 0, cubical = 0;
  for (const CaseResult& found : result.cases) {
    EXPECT_TRUE(found.failures.empty()) << found.name;
    if (found.grid.contains("aspect")) {
      ++cubical;
      const bool by_tiles = found.grid["name"].get<std::string>().find("aspect") != std::string::npos;
      const double most_off = by_tiles ? 0.2 : 1e-4;  // a whole number of tiles
      EXPECT_NEAR(found.grid["aspect"]["min"].get<double>(), 1.0, most_off) << found.name;
      EXPECT_NEAR(found.grid["aspect"]["max"].get<double>(), 1.0, most_off) << found.name;
    }
    if (!found.fit) continue;
    ++fitted;
    const FitResult& fit = *found.fit;
    if (fit.fit.to == grid::Fit::To::lights) {
      EXPECT_EQ(in_view(fit.fitted).missed, in_view(fit.unfitted).missed) << found.name;
    }
    EXPECT_LT(in_view(fit.fitted).evaluated, in_view(fit.unfitted).evaluated) << found.name;
    EXPECT_LE(fit.moves.far_m.greatest, fit.range.far_m);
    if (found.scene != "steps" && found.scene != "hall-1024") continue;
    if (fit.fit == grid::Fit{}) moved_at_once += fit.moves.moved.sum;
    if (fit.fit == grid::Fit{grid::Fit::To::lights, 0.9, 1.0}) moved_damped += fit.moves.moved.sum;
  }
  EXPECT_GT(fitted, 20);
  EXPECT_GT(cubical, 20);
  EXPECT_LT(moved_damped, moved_at_once);
}

}  // namespace
}  // namespace clusterbench::run
