#include <limits>

#include "assign/box_grids_brute_force.h"

namespace clusterbench::assign::testing {
namespace {

grid::GridSpec cascades_spec(Vec3i cells, int levels) {
  grid::GridSpec spec;
  spec.kind = grid::Kind::cascades;
  spec.cells = cells;
  spec.levels = levels;
  spec.finest_m = 0.7;
  return spec;
}

view::Frame frame_with(std::vector<scene::WorldLight> lights) {
  return frame_of(perspective(M_PI / 3, 16.0 / 9.0, 0.1, 400), {1920, 1080}, std::move(lights));
}

TEST(Cascades, list_what_every_light_against_every_box_lists_and_nothing_in_holes) {
  for (const auto& spec : {cascades_spec({16, 16, 16}, 5), cascades_spec({4, 8, 2}, 3), cascades_spec({8, 4, 8}, 1)}) {
    const view::Frame frame = frame_with(random_lights(150, 0, 41));
    const grid::Grid grid = grid_of(spec, frame);
    EXPECT_EQ(lists_by("cascades", frame, grid),
              every_box_by_distance(view::lights_in(frame, grid::space_of(grid, frame)), grid));
  }
}

TEST(Cascades, hold_every_drawn_point_of_random_points_and_spots_in_every_spot_mode) {
  const view::Frame frame = frame_with(random_lights(100, 150, 42));
  const grid::Grid grid = grid_of(cascades_spec({16, 16, 16}, 5), frame);
  for (const char* spot : {"sphere", "range", "cone-sphere", "both"})
    EXPECT_EQ(count_misses(frame, grid, lists_by("cascades", frame, grid, {{"spot", std::string(spot)}}), 2000, 43), 0)
        << spot;
}

TEST(Cascades, list_an_unbounded_light_in_every_cell_that_is_no_hole) {
  const view::Frame frame =
      frame_with({point_light({0, 0, -10}, std::numeric_limits<double>::infinity()), point_light({0, 0, -10}, 0)});
  const grid::Grid grid = grid_of(cascades_spec({8, 8, 8}, 3), frame);
  const Lists lists = lists_by("cascades", frame, grid);
  for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell)
    EXPECT_EQ(lists.of(cell).size(), grid.is_hole(cell) ? 0u : 1u) << "cell " << cell;
}

}  // namespace
}  // namespace clusterbench::assign::testing
