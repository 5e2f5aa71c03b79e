#include <limits>

#include "assign/box_grids_brute_force.h"

namespace clusterbench::assign::testing {
namespace {

grid::GridSpec world_spec(Vec3i cells) {
  grid::GridSpec spec;
  spec.kind = grid::Kind::world;
  spec.cells = cells;
  spec.has_bounds = true;
  spec.bounds_lo_m = Vec3d{-100, -30, -300};
  spec.bounds_hi_m = Vec3d{100, 60, 20};
  return spec;
}

view::Frame frame_with(std::vector<scene::WorldLight> lights) {
  return frame_of(perspective(M_PI / 3, 16.0 / 9.0, 0.1, 400), {1920, 1080}, std::move(lights));
}

TEST(WorldGrid, lists_what_every_light_against_every_box_lists) {
  for (const Vec3i cells : {Vec3i{32, 8, 40}, Vec3i{1, 1, 1}, Vec3i{60, 1, 3}}) {
    const view::Frame frame = frame_with(random_lights(200, 0, 31));
    const grid::Grid grid = grid_of(world_spec(cells), frame);
    EXPECT_EQ(lists_by("world-grid", frame, grid),
              every_box_by_distance(view::lights_in(frame, grid::space_of(grid, frame)), grid));
  }
}

TEST(WorldGrid, holds_every_drawn_point_of_random_points_and_spots_in_every_spot_mode) {
  view::Frame frame = frame_with(random_lights(100, 150, 32));
  frame.view_space.origin = {3, 2, 1};  // the eye does not matter to the world's boxes
  const grid::Grid grid = grid_of(world_spec({32, 8, 40}), frame);
  for (const char* spot : {"sphere", "range", "cone-sphere", "both"})
    EXPECT_EQ(count_misses(frame, grid, lists_by("world-grid", frame, grid, {{"spot", std::string(spot)}}), 2000, 33),
              0)
        << spot;
}

TEST(WorldGrid, takes_what_an_unbounded_light_touches_and_skips_a_light_without_volume) {
  const view::Frame frame =
      frame_with({point_light({0, 0, -10}, std::numeric_limits<double>::infinity()), point_light({0, 0, -10}, 0)});
  const grid::Grid grid = grid_of(world_spec({4, 4, 4}), frame);
  EXPECT_EQ(lists_by("world-grid", frame, grid).lights, std::vector<std::uint32_t>(64, 0u));
}

TEST(WorldGrid, lists_a_light_on_both_sides_of_a_boundary_that_it_touches) {
  const view::Frame frame = frame_with({point_light({10, 0, -100}, 10)});
  const grid::Grid grid = grid_of(world_spec({2, 1, 1}), frame);
  EXPECT_EQ(lists_by("world-grid", frame, grid).lights, (std::vector<std::uint32_t>{0, 0}));
}

}  // namespace
}  // namespace clusterbench::assign::testing
