// World grids along a path as engines have them: Just Cause 2's tiles around the camera, the grid of Humus' demo with a
// bitfield per cell, and PlayCanvas' grid around the lights in view.

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "run/cases/path_frames.h"
#include "run/walk.h"

namespace clusterbench::run {
namespace {

using testing::Walk;

constexpr int k_frames = 24;

// Lights left and right of the path, beside the eye and far ahead of it.
std::vector<std::pair<Vec3d, double>> lights_beside_the_path(int count) {
  SplitMix64 random(11);
  std::vector<std::pair<Vec3d, double>> lights;
  for (int i = 0; i < count; ++i) {
    const double x = random.between(-30.0, 30.0), y = random.between(-4.0, 4.0), z = random.between(-60.0, 20.0);
    lights.emplace_back(Vec3d{x, y, z}, random.between(0.5, 6.0));
  }
  return lights;
}

Result run_along(const std::string& settings, int lights = 60) {
  Walk walk(settings, k_frames);
  for (const auto& [place, range_m] : lights_beside_the_path(lights)) walk.add_light(place, range_m);
  return walk.run();
}

TEST(WorldTilesAroundTheCamera, count_what_circles_against_tiles_count_frame_by_frame) {
  const Result result = run_along(
      R"("grids": [{"kind": "world", "cells": [8, 1, 8], "follow": "camera", "cell_size": [4, null, 4]}],
         "assigners": ["world-grid", "world-grid-fast"], "storages": [{"name": "fixed", "cap": 4, "counts": "none"}],
         "limits": {"dropped_pairs": null})");
  std::uint64_t pairs = 0, dropped = 0;
  for (int frame = 0; frame < k_frames; ++frame) {
    const int eye_x = 0, eye_z = static_cast<int>(std::floor(-frame / 4.0));  // tile of the eye, which goes along -z
    for (int z = eye_z - 4; z < eye_z + 4; ++z)
      for (int x = eye_x - 4; x < eye_x + 4; ++x) {
        std::uint64_t here = 0;
        for (const auto& [place, range_m] : lights_beside_the_path(60)) {
          const double dx = place.x - std::clamp(place.x, 4.0 * x, 4.0 * x + 4.0);
          const double dz = place.z - std::clamp(place.z, 4.0 * z, 4.0 * z + 4.0);
          here += dx * dx + dz * dz <= range_m * range_m ? 1 : 0;
        }
        pairs += here;
        dropped += here > 4 ? here - 4 : 0;
      }
  }
  EXPECT_GT(dropped, 0u);
  for (const CaseResult& found : result.cases) {
    EXPECT_EQ(found.error->true_pairs, pairs);
    EXPECT_EQ(found.error->reported_pairs, pairs);
    EXPECT_EQ(found.error->false_negatives, 0u);
    EXPECT_EQ(found.buffers.dropped_pairs, dropped);
    EXPECT_EQ(found.buffers.bytes.high_water, 8u * 8u * 4u) << "an RGBA8 texel per tile";
    EXPECT_EQ(found.grid["follow"], "camera");
  }
}

TEST(WorldTilesAroundTheCamera, are_built_anew_where_the_eye_enters_another_tile) {
  Walk walk(R"("grids": [{"kind": "world", "cells": [8, 1, 8], "follow": "camera"}])", k_frames);
  walk.add_light({0.0, 0.0, -20.0}, 5.0);
  const PathFrames path = path_of(walk.config, walk.plan, walk.plan.groups[0]);
  GridOfFrames grids(walk.config.grids[0]);
  std::vector<int> made;
  for (int i = 0; i < path.count(); ++i)
    if (grids.update(path, path.frame(i))) made.push_back(i);
  EXPECT_EQ(made, (std::vector<int>{0, 1, 5, 9, 13, 17, 21})) << "z = 0 is in the tile from 0 to 4";
}

TEST(WorldWithABitfield, keeps_a_word_per_32_lights_in_each_cell) {
  for (const int lights : {32, 33, 128}) {
    const Result result = run_along(R"("grids": [{"kind": "world", "cells": [16, 4, 16]}],
                                       "assigners": ["world-grid"], "storages": ["bitfield"])",
                                    lights);
    const CaseResult& found = result.cases.at(0);
    EXPECT_EQ(found.buffers.bytes.high_water, 16u * 4u * 16u * 4u * ((static_cast<unsigned>(lights) + 31) / 32));
    EXPECT_EQ(found.shading->missed, 0u);
  }
}

TEST(WorldAroundTheLightsInView, loses_no_light_and_has_smaller_cells_than_around_all) {
  const std::string rest = R"("assigners": ["world-grid", "world-grid-fast", "bvh", "light-boxes"],
                              "shading": {"samples": 4000})";
  const Result all = run_along(R"("grids": [{"kind": "world", "cells": [16, 4, 16]}], )" + rest),
               followed =
                   run_along(R"("grids": [{"kind": "world", "cells": [16, 4, 16], "follow": "lights"}], )" + rest);
  for (std::size_t i = 0; i < all.cases.size(); ++i) {
    EXPECT_TRUE(followed.cases[i].failures.empty());
    EXPECT_EQ(followed.cases[i].error->false_negatives, 0u);
    EXPECT_EQ(followed.cases[i].shading->missed, 0u);
    EXPECT_EQ(followed.cases[i].shading->needed, all.cases[i].shading->needed);
    EXPECT_LT(followed.cases[i].grid["cell_size"][2], all.cases[i].grid["cell_size"][2]);
  }
  EXPECT_LT(followed.cases[0].shading->evaluated, all.cases[0].shading->evaluated);
}

TEST(WorldAroundTheLightsInView, gives_the_same_whichever_frames_are_asked_for) {
  Walk walk(R"("grids": [{"kind": "world", "follow": "lights"}])", k_frames);
  for (const auto& [place, range_m] : lights_beside_the_path(20)) walk.add_light(place, range_m);
  const PathFrames path = path_of(walk.config, walk.plan, walk.plan.groups[0]), some = path.only({3, 20});
  EXPECT_EQ(some.inputs(walk.config.grids[0], some.frame(1)), path.inputs(walk.config.grids[0], path.frame(20)));
}

}  // namespace
}  // namespace clusterbench::run
