#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "library/assign.h"
#include "library/cases.h"

namespace clusterbench::library {
namespace {

using testing::engine_frame;
using testing::EngineFrame;
using testing::settings_for;

constexpr double k_grid_nan = std::numeric_limits<double>::quiet_NaN();
constexpr double k_grid_inf = std::numeric_limits<double>::infinity();

// Why start() refuses the grid; "" if it does not.
std::string refused_at_start(const Grid& grid, std::string_view method) {
  LightLists lists;
  const bool is_started = lists.start(settings_for(grid, method));
  EXPECT_EQ(is_started, lists.error().empty());
  return std::string(lists.error());
}

std::string refused_in_update(const Grid& grid, const EngineFrame& frame) {
  LightLists lists;
  EXPECT_TRUE(lists.start(settings_for(grid, "exact-fast"))) << lists.error();
  const bool is_made = lists.update(frame.view, frame.lights());
  EXPECT_EQ(is_made, lists.error().empty());
  return std::string(lists.error());
}

struct BadGrid {
  const char* error;
  void (*spoil)(Grid& grid);
};

void expect_refused_at_start(const Grid& good, std::string_view method, const std::vector<BadGrid>& bad) {
  EXPECT_EQ(refused_at_start(good, method), "");
  for (const BadGrid& each : bad) {
    Grid grid = good;
    each.spoil(grid);
    const std::string error = refused_at_start(grid, method);
    EXPECT_TRUE(error.starts_with(each.error)) << error << "\nexpected: " << each.error;
  }
}

TEST(Grids, with_impossible_tiles_are_refused_at_the_start) {
  expect_refused_at_start(
      {}, "exact-fast",
      {{"grid.columns: is 1000000000; allowed: 1 to 1048576", [](Grid& g) { g.columns = g.rows = 1000000000; }},
       {"grid.rows: is -4; allowed: 1 to 1048576", [](Grid& g) { g.columns = 4, g.rows = -4; }},
       {"grid.columns, grid.rows, grid.slices: make 100000 x 100000 x 16 cells; allowed: 10^9 in all",
        [](Grid& g) { g.columns = g.rows = 100000; }},
       {"grid.tile_height: is -4; allowed: 1 or more", [](Grid& g) { g.tile_height = -4; }}});
}

TEST(Grids, with_impossible_slices_are_refused_at_the_start) {
  expect_refused_at_start(
      {}, "exact-fast",
      {{"grid.slices: is 1; allowed: 2 to 4096, since exponential_first", [](Grid& g) { g.slices = 1; }},
       {"grid.slices: is -1; allowed: 1 to 4096", [](Grid& g) { g.slices = -1; }},
       {"grid.slices: is 5000; allowed: 1 to 4096", [](Grid& g) { g.slices = 5000; }},
       {"grid.near_m: is nan; allowed: 0 (the camera's), or", [](Grid& g) { g.near_m = k_grid_nan; }},
       {"grid.near_m: is 2e+15; allowed: ", [](Grid& g) { g.near_m = 2e15; }},
       {"grid.far_m: is inf; allowed: 0 (the camera's), or", [](Grid& g) { g.far_m = k_grid_inf; }},
       {"grid.far_m: is nan; allowed: ", [](Grid& g) { g.far_m = k_grid_nan; }},
       {"grid.near_m, grid.far_m: are 10 and 5; allowed: near_m below far_m",
        [](Grid& g) { g.near_m = 10.0, g.far_m = 5.0; }},
       {"grid.near_m, grid.far_m: are 5 and 5; allowed: ", [](Grid& g) { g.near_m = g.far_m = 5.0; }},
       {"grid.first_m: is 0; allowed: above 0 m, up to 1e15 m", [](Grid& g) { g.first_m = 0.0; }},
       {"grid.first_m: is -1; allowed: ", [](Grid& g) { g.first_m = -1.0; }},
       {"grid.first_m: is nan; allowed: ", [](Grid& g) { g.first_m = k_grid_nan; }},
       {"grid.first_m: is inf; allowed: ", [](Grid& g) { g.first_m = k_grid_inf; }},
       {"grid.first_m: is 5; allowed: above grid.near_m, 7", [](Grid& g) { g.near_m = 7.0, g.far_m = 50.0; }},
       {"grid.first_m: is 5; allowed: below grid.far_m, 4", [](Grid& g) { g.far_m = 4.0; }},
       {"grid.slices: are too thin: two boundaries coincide in single precision, at 1 m",
        [](Grid& g) { g.slicing = Grid::Slicing::linear, g.near_m = 1.0, g.far_m = 1.0 + 1e-9; }}});
}

// Behind the eye there is something to see with an orthographic camera alone.
TEST(Grids, before_the_eye_are_refused_at_the_start_where_no_camera_sees_them) {
  static constexpr double k_behind[] = {-1.0, 2.0};
  Grid grid;
  grid.slicing = Grid::Slicing::linear, grid.near_m = -1.0;
  EXPECT_EQ(refused_at_start(grid, "exact-fast"), "");
  grid.kind = Grid::Kind::distance;
  EXPECT_EQ(refused_at_start(grid, "distance"),
            "grid.near_m: is -1; allowed: 0 (the camera's), or above 0 m, up to 1e15 m");
  EXPECT_EQ(refused_at_start(grid, "bvh"), refused_at_start(grid, "distance"));
  grid.near_m = 0.0, grid.far_m = -5.0;
  EXPECT_TRUE(refused_at_start(grid, "distance").starts_with("grid.far_m: is -5; allowed: "));
  grid.slicing = Grid::Slicing::list, grid.far_m = 0.0, grid.boundaries_m = k_behind;
  EXPECT_EQ(refused_at_start(grid, "distance"), "grid.boundaries_m[0]: is -1; allowed: 0 to 1e15 m");
  grid.kind = Grid::Kind::frustum;
  EXPECT_EQ(refused_at_start(grid, "exact-fast"), "");
}

TEST(Grids, with_an_impossible_list_of_boundaries_are_refused_at_the_start) {
  const auto error_of = [](const std::vector<double>& boundaries, double near_m = 0.0, double far_m = 0.0) {
    Grid grid;
    grid.slicing = Grid::Slicing::list, grid.boundaries_m = boundaries;
    grid.near_m = near_m, grid.far_m = far_m;
    return refused_at_start(grid, "exact-fast");
  };
  EXPECT_EQ(error_of({1.0, 2.0}), "");
  EXPECT_EQ(error_of({1.0}), "grid.boundaries_m: are 1; allowed: 2 to 4097 numbers");
  EXPECT_EQ(error_of({1.0, 2.0, k_grid_inf}), "grid.boundaries_m[2]: is inf; allowed: up to 1e15 m from the eye");
  EXPECT_EQ(error_of({1.0, 1e300}), "grid.boundaries_m[1]: is 1e+300; allowed: up to 1e15 m from the eye");
  EXPECT_EQ(error_of({1.0, k_grid_nan, 3.0}), "grid.boundaries_m[1]: is nan; allowed: up to 1e15 m from the eye");
  EXPECT_EQ(error_of({1.0, 2.0, 2.0 + 1e-12}),
            "grid.boundaries_m: are too thin: two boundaries coincide in single precision, at 2 m");
  EXPECT_EQ(error_of({1.0, 2.0}, 3.0),
            "grid.near_m: is 3, and grid.slicing is list, which has its own ends; allowed: 0");
  EXPECT_EQ(error_of({1.0, 2.0}, 0.0, k_grid_nan),
            "grid.far_m: is nan, and grid.slicing is list, which has its own ends; allowed: 0");
}

TEST(Grids, of_impossible_cascades_are_refused_at_the_start) {
  Grid cascades;
  cascades.kind = Grid::Kind::cascades;
  expect_refused_at_start(
      cascades, "cascades",
      {{"grid.cells: of cascades are 5x16x16; allowed: multiples of 4, 4 and 2", [](Grid& g) { g.cells[0] = 5; }},
       {"grid.cells: of cascades are 16x16x3; allowed: ", [](Grid& g) { g.cells[2] = 3; }},
       {"grid.cells[1]: is 0; allowed: 1 to 65536", [](Grid& g) { g.cells[1] = 0; }},
       {"grid.cells[1]: is -8; allowed: 1 to 65536", [](Grid& g) { g.cells[1] = -8; }},
       {"grid.cells: are more than 10^9: 2000x2000x10000",
        [](Grid& g) { g.cells[0] = g.cells[1] = g.cells[2] = 2000; }},
       {"grid.levels: are 0; allowed: 1 to 24", [](Grid& g) { g.levels = 0; }},
       {"grid.levels: are 99; allowed: 1 to 24", [](Grid& g) { g.levels = 99; }},
       {"grid.levels: are 1000000000; allowed: 1 to 24", [](Grid& g) { g.levels = 1000000000; }},
       {"grid.finest_m: is 0 m; allowed: at least 1e-15 m, and so small that the coarsest of 5 levels, with 16x16x16",
        [](Grid& g) { g.finest_m = 0.0; }},
       {"grid.finest_m: is nan m; allowed: ", [](Grid& g) { g.finest_m = k_grid_nan; }},
       {"grid.finest_m: is inf m; allowed: ", [](Grid& g) { g.finest_m = k_grid_inf; }},
       {"grid.finest_m: is 1e+300 m; allowed: ", [](Grid& g) { g.finest_m = 1e300; }},
       {"grid.finest_m: is 1e-300 m; allowed: ", [](Grid& g) { g.finest_m = 1e-300; }}});
}

TEST(Grids, of_an_impossible_box_of_the_world_are_refused_at_the_start) {
  Grid world;
  world.kind = Grid::Kind::world;
  for (double& number : world.hi_m) number = 1.0;
  expect_refused_at_start(
      world, "world-grid",
      {{"grid.lo_m, grid.hi_m: are from 0 m to 0 m along y; allowed: the first below the second, both within 1e15 m",
        [](Grid& g) { g.hi_m[1] = 0.0; }},
       {"grid.lo_m, grid.hi_m: are from 3 m to 1 m along x; ", [](Grid& g) { g.lo_m[0] = 3.0; }},
       {"grid.lo_m, grid.hi_m: are from 0 m to nan m along z; ", [](Grid& g) { g.hi_m[2] = k_grid_nan; }},
       {"grid.lo_m, grid.hi_m: are from 0 m to inf m along z; ", [](Grid& g) { g.hi_m[2] = k_grid_inf; }},
       {"grid.lo_m, grid.hi_m: are from -2e+15 m to 1 m along x; ", [](Grid& g) { g.lo_m[0] = -2e15; }},
       {"grid.cells[2]: is 0; allowed: 1 to 65536", [](Grid& g) { g.cells[2] = 0; }},
       {"grid.cells: are more than 10^9: 2000x2000x2000",
        [](Grid& g) { g.cells[0] = g.cells[1] = g.cells[2] = 2000; }}});
}

TEST(Grids, that_do_not_fit_the_camera_are_refused_in_its_frames_by_the_argument_that_does_not_fit) {
  static constexpr double k_behind[] = {-1.0, 2.0}, k_thin[] = {0.0, 1e-16, 1.0};
  const EngineFrame frame = engine_frame(10, 5);
  Grid grid;
  grid.columns = 1281, grid.rows = 4;
  EXPECT_EQ(refused_in_update(grid, frame),
            "grid.columns: is 1281, and view.width is 1280; allowed: at most one tile per pixel");
  grid.columns = 4, grid.rows = 721;
  EXPECT_EQ(refused_in_update(grid, frame),
            "grid.rows: is 721, and view.height is 720; allowed: at most one tile per pixel");
  grid = {};
  grid.tile_width = grid.tile_height = 1, grid.slices = 4096;
  EXPECT_EQ(refused_in_update(grid, frame),
            "grid.tile_width, grid.tile_height, grid.slices: make 1280 x 720 x 4096 cells; allowed: 10^9 in all");
  grid = {};
  grid.slicing = Grid::Slicing::linear, grid.far_m = -5.0;
  EXPECT_EQ(refused_in_update(grid, frame), "grid.far_m: is -5 m, which is not above the camera's near, 0.1 m");
  grid.far_m = 0.0, grid.near_m = -1.0;
  EXPECT_EQ(refused_in_update(grid, frame), "grid.near_m: is -1 m; allowed with a perspective camera: 0 m or more");
  grid = {};
  grid.slicing = Grid::Slicing::list, grid.boundaries_m = k_behind;
  EXPECT_EQ(refused_in_update(grid, frame),
            "grid.boundaries_m: begin at -1 m; allowed with a perspective camera: 0 m or more");
  grid.boundaries_m = k_thin;
  EXPECT_TRUE(refused_in_update(grid, frame)
                  .starts_with("grid.boundaries_m: end the first slice at 1.00000002e-16 m; allowed: "));
}

TEST(Grids, of_shells_are_refused_for_orthographic_cameras) {
  Grid grid;
  grid.kind = Grid::Kind::distance;
  EngineFrame frame = engine_frame(10, 5);
  frame.view.is_orthographic = true;
  for (const char* method : {"distance", "bvh"}) {
    LightLists lists;
    ASSERT_TRUE(lists.start(settings_for(grid, method))) << lists.error();
    EXPECT_FALSE(lists.update(frame.view, frame.lights()));
    EXPECT_EQ(lists.error(),
              "view.is_orthographic: is true, and shells of a distance grid lie around an eye; allowed: false, or "
              "another grid.kind");
  }
}

// A camera that sees far behind what slices need is none of their concern.
TEST(Grids, with_an_end_of_their_own_take_a_camera_that_sees_farther_and_tiles_of_any_size) {
  Grid grid;
  grid.far_m = 50.0;
  EngineFrame frame = engine_frame(10, 5);
  frame.view.far_m = 1e300;
  EXPECT_EQ(refused_in_update(grid, frame), "");
  grid.tile_width = grid.tile_height = std::numeric_limits<int>::max();
  EXPECT_EQ(refused_in_update(grid, frame), "");
}

// Numbers that another choice leaves without effect are not looked at.
TEST(Grids, take_any_numbers_that_are_not_used) {
  static constexpr double k_boundaries[] = {1.0, 2.0};
  Grid grid;
  grid.columns = grid.rows = 4, grid.tile_width = -1;
  grid.lambda = k_grid_nan;
  EXPECT_EQ(refused_at_start(grid, "exact-fast"), "");
  grid.slicing = Grid::Slicing::list, grid.boundaries_m = k_boundaries;
  grid.slices = -7, grid.first_m = k_grid_nan;
  EXPECT_EQ(refused_at_start(grid, "exact-fast"), "");
}

}  // namespace
}  // namespace clusterbench::library
