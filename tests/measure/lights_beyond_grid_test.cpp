// Which lights may reach a point in view that lies in no cell, and that none of a point at which samples lack a light
// is left out.

#include "measure/lists/lights_beyond_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

#include "core/error.h"
#include "core/random.h"
#include "effort.h"
#include "grid/lights_in_view.h"
#include "measure/samples/samples.h"
#include "measure/samples/shading.h"

namespace clusterbench::measure {
namespace {

// Looks along -z from the origin, 90 degrees wide and high, 1 to 100 m.
struct BeyondSetting {
  view::Frame frame;
  grid::GridSpec spec;

  explicit BeyondSetting(grid::Kind kind = grid::Kind::frustum) {
    frame.viewport = {64, 64};
    frame.projection = {false, -1.0, 1.0, -1.0, 1.0, 1.0, 100.0};
    spec.kind = kind;
    spec.tiles.pixels = {16, 16};
    spec.slices.scheme = grid::Scheme::linear;
    spec.slices.count = 4;
    spec.slices.far_m = 40.0;
  }

  grid::Grid grid() const {
    return grid::make_grid(spec, grid::grid_inputs(spec, frame, 100.0, Vec3d(-20.0), Vec3d(20.0)));
  }
  bool reaches_beyond(const Vec3d& position, double range_m) const {
    scene::WorldLight light;
    light.position = position;
    light.range_m = range_m;
    return may_reach_beyond(frame, grid(), light);
  }
};

TEST(LightsBeyondGrid, are_those_that_reach_behind_the_last_slice) {
  const BeyondSetting setting;
  EXPECT_FALSE(setting.reaches_beyond({0, 0, -35}, 4.9));
  EXPECT_TRUE(setting.reaches_beyond({0, 0, -35}, 5.1));
  EXPECT_FALSE(setting.reaches_beyond({0, 0, 0.5}, 1.0)) << "is not in view";
  EXPECT_FALSE(setting.reaches_beyond({0, 0, -150}, 20.0)) << "begins behind the camera's far plane";
  EXPECT_TRUE(setting.reaches_beyond({0, 0, -10}, std::numeric_limits<double>::infinity()));
}

TEST(LightsBeyondGrid, there_are_none_where_slices_reach_as_far_as_the_camera_sees) {
  BeyondSetting setting;
  setting.frame.projection.far_m = 40.0;
  EXPECT_FALSE(setting.reaches_beyond({0, 0, -35}, 50.0));
  EXPECT_FALSE(setting.reaches_beyond({0, 0, -10}, std::numeric_limits<double>::infinity()));
}

TEST(LightsBeyondGrid, of_spots_are_told_by_the_smaller_of_two_balls) {
  const BeyondSetting setting;
  scene::WorldLight spot;
  spot.type = scene::LightType::spot;
  spot.position = {0, 0, -35};
  spot.range_m = 20.0;
  spot.outer_cone_rad = 0.3;
  spot.direction = {0, 0, 1};  // towards the eye: the ball of its range ends at 55 m
  EXPECT_FALSE(may_reach_beyond(setting.frame, setting.grid(), spot));
  spot.direction = {0, 0, -1};
  EXPECT_TRUE(may_reach_beyond(setting.frame, setting.grid(), spot));
}

TEST(LightsBeyondGrid, of_shells_are_told_by_distance_and_of_boxes_by_the_box_around_them) {
  const BeyondSetting shells(grid::Kind::distance), world(grid::Kind::world);
  EXPECT_FALSE(shells.reaches_beyond({0, 0, -35}, 4.9));
  EXPECT_TRUE(shells.reaches_beyond({30, 0, -35}, 4.9)) << "46 m away";
  EXPECT_FALSE(world.reaches_beyond({0, 0, -15}, 4.9));
  EXPECT_TRUE(world.reaches_beyond({0, 0, -15}, 5.1));
}

// A sample without an answer that lacks a light is a contradiction where no light reaches beyond the cells.
TEST(LightsBeyondGrid, leave_out_none_that_a_point_without_a_cell_needs) {
  SplitMix64 random(36);
  int beyond = 0, none = 0, without_cell = 0;
  for (int round = 0; round < test::tries(600); ++round) {
    constexpr grid::Kind k_kinds[] = {grid::Kind::frustum, grid::Kind::distance, grid::Kind::world,
                                      grid::Kind::cascades};
    BeyondSetting setting(k_kinds[random.below(4)]);
    setting.frame.projection.orthographic = setting.spec.kind != grid::Kind::distance && random.below(3) == 0;
    if (setting.frame.projection.orthographic)
      setting.frame.projection.left = setting.frame.projection.bottom =
          -(setting.frame.projection.right = setting.frame.projection.top = 12.0);
    setting.frame.projection.far_m = random.below(3) == 0 ? 40.0 : 80.0;
    setting.frame.projection.near_m = random.below(2) == 0 ? 0.1 : 5.0;
    setting.spec.slices.far_m = random.between(10.0, 90.0);
    for (int i = 0; i < 6; ++i) {
      scene::WorldLight& light = setting.frame.lights.emplace_back();
      light.position = {random.between(-15, 15), random.between(-15, 15), random.between(-45, 5)};
      light.range_m = random.between(1.0, 12.0);
      if (i < 3) continue;
      light.type = scene::LightType::spot;
      light.outer_cone_rad = random.between(0.1, 1.5);
      light.direction = glm::normalize(Vec3d(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)));
    }
    setting.frame.count_types();
    const grid::Grid grid = setting.grid();
    LightsBeyondGrid counts;
    add_frame(counts, setting.frame, grid, grid::lights_in_view(setting.frame));
    (counts.most > 0 ? beyond : none) += 1;
    const std::vector<grid::Sample> samples =
        volume_samples(setting.frame, setting.frame.projection.far_m, 500, static_cast<std::uint64_t>(round));
    const assign::Lists needed = lights_reaching(setting.frame, samples);
    for (std::uint32_t i = 0; i < samples.size(); ++i) {
      if (grid::lookup(grid, samples[i]) >= 0) continue;
      ++without_cell;
      for (const std::uint32_t light : needed.of(i))
        EXPECT_TRUE(may_reach_beyond(setting.frame, grid, setting.frame.lights[light]))
            << "round " << round << ", light " << light;
    }
  }
  if (test::k_sanitized) return;
  EXPECT_GT(beyond, 50);
  EXPECT_GT(none, 50);
  EXPECT_GT(without_cell, 1000);
}

}  // namespace
}  // namespace clusterbench::measure
