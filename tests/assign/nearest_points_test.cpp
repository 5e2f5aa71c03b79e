// What many balls and cells are told at once, against deciding each alone; and that exact touches are among it.

#include "assign/exact/nearest_points.h"

#include <gtest/gtest.h>

#include <cmath>

#include "assign/each_target.h"
#include "assign/settings.h"

namespace clusterbench::assign {
namespace {

using testing::on_each_target;

// A camera that is turned about its x axis: depths are rounded, what lies across is not. Each ball touches the left
// side of the column that it is looked at in.
TEST(BallCellsAtOnce, of_orthographic_views_touch_sides_exactly_however_depths_are_rounded) {
  view::Frame frame = testing::frame_of({true, -8.0, 8.0, -4.0, 4.0, 0.0, 64.0}, {1024, 512}, {});
  const double cosine = std::cos(0.7), sine = std::sin(0.7);
  frame.view_space.rotation = glm::transpose(Mat3d{{1, 0, 0}, {0, cosine, -sine}, {0, sine, cosine}});
  grid::GridSpec spec;
  spec.tiles.count = {16, 2};
  spec.slices = {.scheme = grid::Scheme::list, .boundaries_m = {1.0, 40.0}};
  BallCells cells;
  cells.reserve(13);
  for (std::uint32_t i = 0; i < 13; ++i) {
    const int column = static_cast<int>(i) + 2;  // from x = column - 8 on
    scene::WorldLight light;
    light.range_m = 0.75;
    light.position = glm::transpose(frame.view_space.rotation) * Vec3d(column - 8.75, 1.3, -(3.7 + i));
    frame.lights.push_back(light);
    ++frame.points;
    cells.add(i, 0, 0, column);
  }
  const grid::Grid grid = testing::grid_of(spec, frame);
  const view::LightArrays lights = view::lights_in(frame, grid::space_of(grid, frame));
  const RowPlanes planes(grid.screen());
  on_each_target([&](const std::string& target) {
    filter_ball_cells(lights, planes, cells);
    for (std::uint32_t i = 0; i < cells.count; ++i) EXPECT_EQ(cells.touch[i], Touch::yes) << target << ", " << i;
  });
}

}  // namespace
}  // namespace clusterbench::assign
