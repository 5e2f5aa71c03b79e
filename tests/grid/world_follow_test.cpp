// World grids that follow the camera or the lights in view.

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/random.h"
#include "grid/grid.h"
#include "grid/lights_in_view.h"

namespace clusterbench::grid {
namespace {

GridSpec following(Follow follow, Vec3i cells, const Vec3d& cell_size_m = {4.0, 0.0, 4.0}) {
  GridSpec spec;
  spec.kind = Kind::world;
  spec.cells = cells;
  spec.follow = follow;
  spec.cell_size_m = cell_size_m;
  return spec;
}

view::Frame frame_at(const Vec3d& eye, std::vector<scene::WorldLight> lights = {}) {
  view::Frame frame;
  frame.viewport = {640, 360};
  frame.projection = {false, -1.2, 0.8, -0.5, 0.625, 0.5, 80.0};  // off-centre
  frame.view_space.origin = eye;
  frame.lights = std::move(lights);
  return frame;
}

WorldGrid grid_at(const GridSpec& spec, const view::Frame& frame) {
  return make_grid(spec, grid_inputs(spec, frame, 0.0, {-7.0, -3.0, -9.0}, {5.0, 6.0, 11.0})).world();
}

scene::WorldLight lamp(const Vec3d& place, double range_m) {
  scene::WorldLight light;
  light.position = place;
  light.range_m = range_m;
  return light;
}

Vec3d any_direction(SplitMix64& random) {
  while (true) {
    const double x = random.between(-1.0, 1.0), y = random.between(-1.0, 1.0), z = random.between(-1.0, 1.0);
    const double length = std::sqrt(x * x + y * y + z * z);
    if (length < 1.0 && length > 0.01) return Vec3d(x, y, z) / length;
  }
}

TEST(WorldThatFollowsTheCamera, has_its_boundaries_at_whole_cells_of_the_world_and_the_eye_in_its_middle_cell) {
  const GridSpec spec = following(Follow::camera, {128, 1, 32}, {4.0, 0.0, 0.5});
  SplitMix64 random(3);
  for (int i = 0; i < 200; ++i) {
    const Vec3d eye{random.between(-1e4, 1e4), random.between(-9.0, 9.0), i == 0 ? -8.0 : random.between(-1e4, 1e4)};
    const WorldGrid grid = grid_at(spec, frame_at(eye));
    ASSERT_EQ(grid.counts(), (Vec3i{128, 1, 32}));
    for (int k = 0; k <= 128; ++k)
      EXPECT_EQ(grid.origin.x + static_cast<double>(grid.x[static_cast<std::size_t>(k)]),
                4.0 * (std::floor(eye.x / 4.0) - 64 + k));
    EXPECT_EQ(std::fmod(grid.origin.z, 0.5), 0.0);
    EXPECT_LE(grid.origin.z + static_cast<double>(grid.z[16]), eye.z);
    EXPECT_GT(grid.origin.z + static_cast<double>(grid.z[17]), eye.z);
    EXPECT_LT(grid.origin.y + static_cast<double>(grid.y[0]), -3.0) << "one cell around the lights over the path";
    EXPECT_GT(grid.origin.y + static_cast<double>(grid.y[1]), 6.0);
  }
}

TEST(WorldThatFollowsTheCamera, is_another_grid_only_once_the_eye_is_in_another_cell) {
  const GridSpec spec = following(Follow::camera, {8, 1, 8});
  const auto inputs_at = [&](double x) { return grid_inputs(spec, frame_at({x, 100.0, 2.0}), 0.0, {}, {}); };
  EXPECT_EQ(inputs_at(4.0), inputs_at(7.99));
  EXPECT_NE(inputs_at(4.0), inputs_at(3.99));
  EXPECT_NE(inputs_at(4.0), inputs_at(8.0));
}

TEST(WorldThatFollowsTheCamera, takes_given_bounds_where_it_does_not_follow) {
  GridSpec spec = following(Follow::camera, {8, 2, 8});
  spec.has_bounds = true;
  spec.bounds_lo_m = {0.0, -10.0, 0.0};
  spec.bounds_hi_m = {1.0, 30.0, 1.0};
  const WorldGrid grid = grid_at(spec, frame_at({100.0, 0.0, 100.0}));
  EXPECT_EQ(grid.origin, (Vec3d{100.0, 10.0, 100.0}));
  EXPECT_EQ(grid.y[1], 0.0f);
  EXPECT_THROW(grid_at(spec, frame_at({1e15, 0.0, 0.0})), Error) << "beyond the domain";
}

TEST(WorldThatFollowsTheLights, holds_every_point_in_view_that_a_light_reaches) {
  const GridSpec spec = following(Follow::lights, {16, 4, 16});
  SplitMix64 random(5);
  int seen = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3d eye{random.between(-1e3, 1e3), random.between(-10.0, 10.0), random.between(-1e3, 1e3)};
    std::vector<scene::WorldLight> lights;
    for (int n = 0; n < 4; ++n) {
      const Vec3d place{random.between(-60.0, 60.0), random.between(-30.0, 30.0), random.between(-90.0, 20.0)};
      lights.push_back(lamp(eye + place, random.between(0.5, 15.0)));
      if (n < 2) continue;
      lights.back().type = scene::LightType::spot;
      lights.back().direction = any_direction(random);
      lights.back().outer_cone_rad = random.between(0.0, 1.5707963);
    }
    const view::Frame frame = frame_at(eye, lights);
    const Grid grid{grid_at(spec, frame)};
    for (const scene::WorldLight& light : lights)
      for (int n = 0; n < 100; ++n) {
        const Vec3d away = any_direction(random), point = light.position + away * random.unit() * light.range_m;
        const Vec3d view = point - eye;
        const double depth = -view.z;
        const bool in_cone =
            light.type == scene::LightType::point || glm::dot(away, light.direction) >= std::cos(light.outer_cone_rad);
        if (!in_cone || depth < 0.5 || depth > 80.0 || view.x < -1.2 * depth || view.x > 0.8 * depth ||
            view.y < -0.5 * depth || view.y > 0.625 * depth)
          continue;
        ++seen;
        const Sample sample{.pixel_x = 0.0f, .pixel_y = 0.0f, .view = Vec3f(view), .from_eye = view, .eye = eye};
        EXPECT_GE(lookup(grid, sample), 0) << i;
      }
  }
  EXPECT_GT(seen, 5000);
}

TEST(WorldThatFollowsTheLights, is_the_box_around_those_in_view_and_no_larger) {
  const GridSpec spec = following(Follow::lights, {4, 4, 4});
  std::vector<scene::WorldLight> lights{lamp({0, 0, -20}, 2), lamp({3, 1, -30}, 1), lamp({0, 0, 50}, 9)};
  const WorldGrid grid = grid_at(spec, frame_at({0, 0, 0}, lights));
  const auto at = [&](const std::vector<float>& planes, double origin, bool last) {
    return origin + static_cast<double>(last ? planes.back() : planes.front());
  };
  EXPECT_NEAR(at(grid.x, grid.origin.x, false), -2.0, 1e-5);
  EXPECT_NEAR(at(grid.x, grid.origin.x, true), 4.0, 1e-5);
  EXPECT_NEAR(at(grid.y, grid.origin.y, true), 2.0, 1e-5);
  EXPECT_NEAR(at(grid.z, grid.origin.z, false), -31.0, 1e-5);
  EXPECT_NEAR(at(grid.z, grid.origin.z, true), -18.0, 1e-5) << "the light behind the eye is left out";
}

TEST(WorldThatFollowsTheLights, has_the_box_over_the_path_where_a_light_has_no_end_and_a_small_one_without_lights) {
  const GridSpec spec = following(Follow::lights, {4, 4, 4});
  const double no_end = std::numeric_limits<double>::infinity();
  const WorldGrid all = grid_at(spec, frame_at({0, 0, 0}, {lamp({0, 0, -20}, 2), lamp({0, 0, -5}, no_end)}));
  EXPECT_NEAR(all.origin.x + static_cast<double>(all.x.front()), -7.0, 1e-5);
  const WorldGrid none = grid_at(spec, frame_at({0, 0, 0}, {lamp({0, 0, 50}, 2)}));
  EXPECT_NEAR(none.x.back() - none.x.front(), 1.0f, 1e-5f);
}

TEST(BoxAroundASpot, touches_the_cone_on_each_side_that_ends_in_it) {
  scene::WorldLight light = lamp({1, 2, 3}, 10);
  light.type = scene::LightType::spot;
  light.direction = {0, 0, -1};
  light.outer_cone_rad = 0.5;
  const WorldBox box = box_around(light);
  const double beside = 10 * std::sin(0.5);
  EXPECT_NEAR(glm::length(box.lo - Vec3d(1 - beside, 2 - beside, -7)), 0.0, 1e-9);
  EXPECT_NEAR(glm::length(box.hi - Vec3d(1 + beside, 2 + beside, 3)), 0.0, 1e-9);
}

TEST(WorldGridNames, tell_what_is_followed) {
  EXPECT_EQ(following(Follow::camera, {128, 1, 128}).name(), "world 128x1x128 follows camera 4x*x4m");
  EXPECT_EQ(following(Follow::lights, {8, 8, 8}).name(), "world 8x8x8 follows lights");
  EXPECT_EQ(following(Follow::nothing, {8, 8, 8}).name(), "world 8x8x8");
}

}  // namespace
}  // namespace clusterbench::grid
