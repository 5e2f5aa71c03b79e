// Frames whose projection is jittered: the grid follows, and every method keeps what it promises.

#include <gtest/gtest.h>

#include <set>

#include "places.h"
#include "run/runner.h"
#include "run/walk.h"

namespace clusterbench::run {
namespace {

Result jittered_street(const std::string& jitter) {
  const config::Config config = config::parse_config(R"({"scenes": [{"path": ")" + test::source_dir() +
                                                         R"(/scenes/street.glb", "frames": 3}], "viewport": [640, 360],
          "grids": [{"kind": "frustum", "tiles": {"pixels": [[64, 64], [48, 37]]}, "slices": {"count": 12}},
                    {"kind": "distance", "slices": {"count": 12}}, {"kind": "cascades"}, {"kind": "world", "cells": [24, 4, 24]}],
          "storages": ["packed", "bitfield"], "shading": {"samples": 400}, "lookup": {"samples": 3000, "logarithms": ["rounded"], "depths": ["given"]},
          "timing": {"measure": false}, "threads": 2, "jitter": )" +
                                                         jitter + "}",
                                                     "c.json");
  const std::atomic<bool> stop{false};
  return run_plan(config, make_plan(config, ""), {}, {}, stop);
}

TEST(Jitter, every_method_keeps_its_promise_on_every_grid) {
  const Result result = jittered_street(R"([[0.3125, -0.1875], [-8, 5.5], [15.7, 16]])");
  std::set<std::string> exact, conservative;
  for (const CaseResult& one : result.cases) {
    if (one.error && one.conservative) {
      conservative.insert(one.assigner);
      EXPECT_EQ(one.error->false_negatives, 0u) << one.name;
      EXPECT_EQ(one.error->undecided, 0u) << one.name;
    }
    if (one.error && one.exact) {
      exact.insert(one.assigner);
      EXPECT_EQ(one.error->false_positives, 0u) << one.name;
    }
  }
  EXPECT_GE(exact.size(), 2u);
  EXPECT_GE(conservative.size(), 12u);
}

// Samples beside tiles' edges and at lights' ends find what they need in the grid of their own frame, but for rounding;
// in the grid of the frame before it would be a hundred times as much.
TEST(Jitter, samples_find_their_lists_in_the_grid_of_their_own_frame) {
  int tried = 0;
  for (const CaseResult& case_result : jittered_street(R"([[-8, 5.5], [15.7, 16]])").cases) {
    if (!case_result.conservative || case_result.grid["kind"] != "frustum") continue;
    for (const measure::LookupCounts& lookup : case_result.lookup) {
      if (lookup.way.logarithm != measure::Logarithm::rounded || lookup.way.depth != measure::DepthRead::given)
        continue;
      ASSERT_GT(lookup.needed, 10'000u);
      EXPECT_LE(lookup.missed * 2000, lookup.needed) << case_result.name;
      ++tried;
    }
  }
  EXPECT_GT(tried, 10);
}

TEST(Jitter, changes_what_is_in_the_cells_and_only_on_grids_of_the_screen) {
  const Result still = jittered_street("null"), moved = jittered_street(R"([[-8, 5.5]])");
  ASSERT_EQ(still.cases.size(), moved.cases.size());
  for (std::size_t i = 0; i < still.cases.size(); ++i) {
    const CaseResult &a = still.cases[i], &b = moved.cases[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_NE(a.id, b.id);
    if (!a.error) continue;
    const std::string kind = a.grid["kind"];
    EXPECT_EQ(a.error->true_pairs != b.error->true_pairs, kind == "frustum" || kind == "distance") << a.name;
  }
}

TEST(Cameras, that_are_animated_and_not_measured_are_named_in_a_warning) {
  testing::Walk walk(std::string(testing::k_shafts) + R"(, "assigners": ["aabb"])");
  walk.add_light({0.0, 0.0, -5.0}, 2.0);
  for (const char* name : {"eye", "drone", "cutscene"}) {
    scene::Camera camera;
    camera.name = name;
    camera.animated = true;
    walk.plan.scenes[0].scene.cameras.push_back(camera);
  }
  EXPECT_EQ(walk.run().scenes.at(0).warnings,
            (std::vector<std::string>{"not measured: 2 cameras beside 'eye': drone, cutscene; "
                                      "\"camera\": \"*\" measures all"}));
}

}  // namespace
}  // namespace clusterbench::run
