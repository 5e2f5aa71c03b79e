#include <limits>

#include "assign/dense_check.h"
#include "geom/shapes/cell.h"

namespace clusterbench::assign::testing {
namespace {

grid::GridSpec shells(Vec2i tiles, int count) {
  grid::GridSpec spec;
  spec.kind = grid::Kind::distance;
  spec.tiles = {{0, 0}, tiles};
  spec.slices.scheme = grid::Scheme::exponential;
  spec.slices.count = count;
  spec.slices.near_m = 0.1;
  spec.slices.far_m = 400;
  return spec;
}

view::Frame frame_at(double fov_deg, std::vector<scene::WorldLight> lights) {
  return frame_of(perspective(fov_deg * M_PI / 180, 16.0 / 9.0, 0.1, 400), {1920, 1080}, std::move(lights));
}

TEST(Distance, holds_every_drawn_point_of_random_points_and_spots_in_every_spot_mode) {
  const view::Frame frame = frame_at(60, random_lights(150, 150, 21));
  const grid::Grid grid = grid_of(shells({16, 9}, 24), frame);
  for (const char* spot : {"sphere", "range", "cone-sphere", "both"})
    EXPECT_EQ(count_misses(frame, grid, lists_by("distance", frame, grid, {{"spot", std::string(spot)}}), 2000, 22), 0)
        << spot;
}

TEST(Distance, holds_every_drawn_point_in_wide_and_narrow_views) {
  for (const double fov : {1.0, 120.0, 170.0}) {
    const view::Frame frame = frame_at(fov, random_lights(80, 80, 23));
    const grid::Grid grid = grid_of(shells({13, 40}, 12), frame);
    EXPECT_EQ(count_misses(frame, grid, lists_by("distance", frame, grid), 1000, 24), 0) << fov;
  }
}

TEST(Distance, an_eye_in_the_ball_has_the_light_in_every_tile_of_the_shells_that_it_fills) {
  const view::Frame frame = frame_at(60, {point_light({0.5, 0, 1}, 10)});
  const grid::Grid grid = grid_of(shells({4, 3}, 8), frame);
  const Lists lists = lists_by("distance", frame, grid);
  for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell) {
    const auto shell = static_cast<std::size_t>(grid.cell_at(cell).z);
    const float begins = grid.screen().slices.boundaries[shell];
    if (begins > 8.8f && begins < 11.2f) continue;
    EXPECT_EQ(lists.of(cell).size(), begins < 10 ? 1u : 0u) << "cell " << cell;
  }
}

// Along each tile's pixels and shell's distances, the nearest one to the centre: an upper bound of the cell's distance.
double sampled_distance(const geom::ShellCell& cell, Vec3d center) {
  double nearest = std::numeric_limits<double>::infinity();
  const int steps = 24;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j) {
      const double x = cell.x0 + (cell.x1 - cell.x0) * i / steps, y = cell.y0 + (cell.y1 - cell.y0) * j / steps;
      const Vec3d ray = glm::normalize(Vec3d{x, y, -1});
      const double along = std::clamp<double>(glm::dot(ray, center), cell.distance0, cell.distance1);
      nearest = std::min(nearest, glm::length(along * ray - center));
    }
  return nearest;
}

TEST(Distance, lists_no_cell_that_the_ball_clearly_misses) {
  const view::Frame frame = frame_at(60, random_lights(60, 0, 25));
  const grid::Grid grid = grid_of(shells({16, 9}, 16), frame);
  const Lists lists = lists_by("distance", frame, grid);
  for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell)
    for (const std::uint32_t light : lists.of(cell)) {
      // With the eye in the ball the cap can be wider than a half-space; then whole shells are taken.
      if (glm::length(frame.lights[light].position) < frame.lights[light].range_m) continue;
      const auto shell = std::get<geom::ShellCell>(grid.cell(cell));
      const double distance = sampled_distance(shell, frame.lights[light].position);
      const double step = 0.01 * shell.distance1;
      ASSERT_LE(distance, frame.lights[light].range_m + step) << "cell " << cell << " light " << light;
    }
}

TEST(Distance, takes_what_an_unbounded_light_touches_and_skips_a_light_without_volume) {
  const view::Frame frame = frame_at(60, {point_light({0, 0, -10}, std::numeric_limits<double>::infinity()),
                                          point_light({0, 0, -10}, 0), point_light({0, 0, 0}, 1)});
  const grid::Grid grid = grid_of(shells({4, 3}, 8), frame);
  const Lists lists = lists_by("distance", frame, grid);
  std::uint32_t listed[3] = {};
  for (const std::uint32_t light : lists.lights) ++listed[light];
  EXPECT_EQ(listed[0], grid.cell_count());
  EXPECT_EQ(listed[1], 0u);
  EXPECT_GT(listed[2], 0u);
}

}  // namespace
}  // namespace clusterbench::assign::testing
