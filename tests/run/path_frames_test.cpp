#include "run/cases/path_frames.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace clusterbench::run
