#include "run/cases/path_lights.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "grid/lights_in_view.h"
#include "run/cases/path_frames.h"
#include "run/walk.h"

namespace clusterbench::run {
namespace {

TEST(PathLights, in_view_are_those_of_each_frame_also_where_they_are_not_kept) {
  testing::Walk walk(testing::k_shafts, 30);
  for (int i = 0; i < 40; ++i) walk.add_light({0.5 * (i % 5), 0.0, -1.0 * i}, 1.0);
  const SceneData& data = walk.plan.scenes[0];
  const Vec2i viewport{100, 100};
  for (const int threads : {1, 2, 3})
    for (const std::size_t most_bytes : {std::size_t{0}, std::size_t{1000}, PathLights::k_most_bytes}) {
      const auto lights =
          std::make_shared<const PathLights>(path_lights(data.scene, data.paths[0], viewport, threads, most_bytes));
      EXPECT_EQ(lights->in_view.size(), most_bytes == PathLights::k_most_bytes ? 30u : 0u);
      EXPECT_LE(lights->in_view.empty() ? 0 : lights->bytes() - lights->lights->size() * sizeof(scene::WorldLight),
                most_bytes);
      const PathFrames path(data.scene, data.paths[0], viewport, lights, nullptr, threads, nullptr);
      for (const int i : {0, 7, 29}) {
        const std::vector<bool> in_view = path.lights_in_view(path.frame(i));
        EXPECT_EQ(in_view, grid::lights_in_view(path.frame(i)));
        EXPECT_NE(std::ranges::count(in_view, true), 0);
        EXPECT_NE(in_view, path.lights_in_view(path.frame(i == 0 ? 29 : 0)));
      }
      EXPECT_EQ(path.only({7}).lights_in_view(path.frame(7)), grid::lights_in_view(path.frame(7)));
    }
}

TEST(PathLights, of_a_path_along_another_are_its_own) {
  testing::Walk walk(testing::k_shafts, 4);
  for (int i = 0; i < 40; ++i) walk.add_light({0.0, 0.0, -1.0 * i}, 1.0);
  const SceneData& data = walk.plan.scenes[0];
  scene::CameraPath back = data.paths[0];
  for (scene::Shot& shot : back.shots) shot.pose.eye.z -= 20.0;
  const PathFrames path(data.scene, data.paths[0], {100, 100}), along = path.along(back);
  EXPECT_EQ(along.lights_in_view(along.frame(2)), grid::lights_in_view(along.frame(2)));
  EXPECT_NE(along.lights_in_view(along.frame(2)), path.lights_in_view(path.frame(2)));
}

TEST(PathLights, are_found_again_after_more_than_fit) {
  testing::Walk walk(testing::k_shafts, 400);
  for (int i = 0; i < 100'000; ++i) walk.add_light({0.0, 0.0, -1.0 * (i % 400)}, 1.0);
  walk.config.viewports = {{100, 100}, {64, 64}, {32, 32}};
  SceneData& data = walk.plan.scenes[0];
  data.paths[0].shots.resize(60);
  const auto of = [&](std::size_t viewport) {
    return data.path_lights->of(data.scene, data.paths[0], 0, walk.config.viewports[viewport], 2);
  };
  const auto first = of(0);
  EXPECT_GT(2 * first->bytes(), PathLights::k_most_bytes);
  EXPECT_EQ(of(0), first);
  const auto second = of(1);
  EXPECT_EQ(data.path_lights->times_found(), 2);
  EXPECT_EQ(of(1), second);
  EXPECT_EQ(data.path_lights->times_found(), 2);
  EXPECT_EQ(of(0)->reach.far_m(), first->reach.far_m());
  EXPECT_EQ(data.path_lights->times_found(), 3);
}

}  // namespace
}  // namespace clusterbench::run
