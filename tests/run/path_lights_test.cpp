#include "run/cases/path_lights.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/parallel.h"
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
  const SharedLights static_lights = find_static_lights(data.scene, 0.0);
  for (const int threads : {1, 2, 3})
    for (const std::size_t most_bytes : {std::size_t{0}, std::size_t{1000}, PathLights::k_most_bytes}) {
      const auto lights = std::make_shared<const PathLights>(
          path_lights(data.scene, data.paths[0], viewport, static_lights, threads, most_bytes));
      EXPECT_EQ(lights->in_view.size(), most_bytes == PathLights::k_most_bytes ? 30u : 0u);
      EXPECT_LE(lights->bytes_in_view(), most_bytes);
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

TEST(PathLights, are_kept_while_they_fit_and_then_found_again) {
  testing::Walk walk(testing::k_shafts, 50);
  for (int i = 0; i < 200; ++i) walk.add_light({0.0, 0.0, -1.0 * (i % 50)}, 1.0);
  const SceneData& data = walk.plan.scenes[0];
  const Vec2i viewports[] = {{100, 100}, {64, 64}, {32, 32}};
  const auto one = PathLightsOfScene().of(data.scene, data.paths[0], 0, viewports[0], 2);
  PathLightsOfScene two(2 * one->bytes_in_view());
  const auto of = [&](int viewport) { return two.of(data.scene, data.paths[0], 0, viewports[viewport], 2); };
  const auto first = of(0), second = of(1);
  EXPECT_EQ(of(0), first);
  EXPECT_EQ(of(1), second);
  EXPECT_EQ(first->static_lights, second->static_lights);
  EXPECT_EQ(two.times_found(), 2);
  of(2);
  EXPECT_EQ(of(1), second);
  EXPECT_EQ(two.times_found(), 3);
  EXPECT_EQ(of(0)->in_view, first->in_view);
  EXPECT_EQ(two.times_found(), 4);
}

TEST(PathLights, of_several_views_are_found_at_the_same_time_and_once_each) {
  testing::Walk walk(testing::k_shafts, 300);
  for (int i = 0; i < 300; ++i) walk.add_light({0.0, 0.0, -1.0 * i}, 1.0);
  const SceneData& data = walk.plan.scenes[0];
  PathLightsOfScene all;
  ThreadPool pool(4);
  std::vector<std::shared_ptr<const PathLights>> found(16);
  pool.each(found.size(), [&](std::size_t i) {
    const int side = 32 + static_cast<int>(i % 4);
    found[i] = all.of(data.scene, data.paths[0], 0, {side, side}, 2);
  });
  EXPECT_EQ(all.times_found(), 4);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i], found[i % 4]) << i;
}

}  // namespace
}  // namespace clusterbench::run
