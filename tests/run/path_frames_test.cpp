#include "run/cases/path_frames.h"

#include <gtest/gtest.h>

#include <utility>

#include "run/walk.h"

namespace clusterbench::run {
namespace {

int grids_made(const config::Config& config, std::size_t grid, const PathFrames& path) {
  GridOfFrames grids(config.grids[grid]);
  int made = 0;
  for (int i = 0; i < path.count(); ++i) made += grids.update(path, path.frame(i)) ? 1 : 0;
  return made;
}

TEST(GridOfFrames, is_made_once_along_a_path_and_again_only_where_its_projection_changes) {
  testing::Walk walk(R"("grids": [{"kind": "frustum"}, {"kind": "distance"}, {"kind": "cascades"}, {"kind": "world"}])",
                     6);
  walk.add_light({0.0, 0.0, -20.0}, 5.0);
  const SceneData& data = walk.plan.scenes[0];
  scene::CameraPath zooms = data.paths[0];
  zooms.shots[3].projection.yfov_rad = 1.0;
  const PathFrames steady(data.scene, data.paths[0], {100, 100}), zooming(data.scene, zooms, {100, 100});
  for (std::size_t grid = 0; grid < walk.config.grids.size(); ++grid)
    EXPECT_EQ(grids_made(walk.config, grid, steady), 1) << grid;
  EXPECT_EQ(grids_made(walk.config, 0, zooming), 3);  // there and back
  EXPECT_EQ(grids_made(walk.config, 3, zooming), 1) << "a world grid does not follow the camera";
}

// Moves the walk's first light by a metre a second; each frame is half a second after the one before.
void move_light(testing::Walk& walk) {
  scene::Channel channel;
  channel.node = walk.plan.scenes[0].scene.lights[0].node;
  channel.path = scene::ChannelPath::translation;
  channel.times_s = {0.0, 100.0};
  channel.values = {{0.0, 0.0, -20.0, 0.0}, {100.0, 0.0, -20.0, 0.0}};
  walk.plan.scenes[0].scene.channels.push_back(channel);
  double time_s = 0.0;
  for (scene::Shot& shot : walk.plan.scenes[0].paths[0].shots) shot.time_s = std::exchange(time_s, time_s + 0.5);
}

TEST(PathFrames, have_the_lights_of_their_moments_on_any_number_of_threads) {
  for (const bool moves : {false, true}) {
    testing::Walk walk(testing::k_shafts, 40);
    walk.add_light({0.0, 0.0, -20.0}, 5.0);
    walk.add_light({3.0, 1.0, -50.0}, 2.0);
    if (moves) move_light(walk);
    const SceneData& data = walk.plan.scenes[0];
    const PathFrames path(data.scene, data.paths[0], {100, 100});
    for (int i = 0; i < path.count(); ++i) {
      const view::Frame frame = path.frame(i);
      const std::vector<scene::WorldLight> lights =
          world_lights(data.scene, data.paths[0].shots[static_cast<std::size_t>(i)].time_s);
      ASSERT_EQ(frame.lights.size(), lights.size());
      for (std::size_t k = 0; k < lights.size(); ++k) EXPECT_EQ(frame.lights[k].position, lights[k].position) << i;
      EXPECT_DOUBLE_EQ(frame.lights[0].position.x, moves ? 0.5 * i : 0.0) << i;
    }
    EXPECT_DOUBLE_EQ(path.light_bounds().hi_m.x, moves ? 5.0 + 0.5 * 39 : 5.0);
    for (const int threads : {2, 3}) {
      const PathFrames shared(data.scene, data.paths[0], {100, 100}, nullptr, threads);
      EXPECT_EQ(shared.far_m(), path.far_m());
      EXPECT_EQ(shared.light_bounds().lo_m, path.light_bounds().lo_m);
      EXPECT_EQ(shared.light_bounds().hi_m, path.light_bounds().hi_m);
    }
  }
}

TEST(PathOf, a_group_is_in_the_groups_own_view) {
  testing::Walk walk(testing::k_shafts, 6);
  walk.add_light({0.0, 0.0, -20.0}, 5.0);
  walk.config.viewports.push_back({64, 32});
  SceneData& data = walk.plan.scenes[0];
  data.paths.push_back(data.paths[0]);
  data.paths[1].shots.resize(2);
  GroupPlan group = walk.plan.groups[0];
  for (const std::size_t camera : {0u, 0u, 1u, 0u})
    for (const std::size_t viewport : {0u, 1u, 1u, 0u}) {
      group.camera = camera;
      group.viewport = viewport;
      const PathFrames path = path_of(walk.config, walk.plan, group);
      EXPECT_EQ(path.count(), camera == 0 ? 6 : 2);
      EXPECT_EQ(path.viewport(), walk.config.viewports[viewport]);
      EXPECT_EQ(path.far_m(), PathFrames(data.scene, data.paths[camera], walk.config.viewports[viewport]).far_m());
    }
  EXPECT_EQ(data.path_lights->times_found(), 4);
}

}  // namespace
}  // namespace clusterbench::run
