#include <limits>

#include "assign/dense_check.h"

namespace clusterbench::assign::testing {
namespace {

grid::GridSpec frustum_12x12x24() {
  grid::GridSpec spec;
  spec.kind = grid::Kind::frustum;
  spec.tiles = {{0, 0}, {12, 12}};
  spec.slices.scheme = grid::Scheme::exponential;
  spec.slices.count = 24;
  spec.slices.near_m = 0.1;
  spec.slices.far_m = 400;
  return spec;
}

const Vec2i k_full_hd{1920, 1080};

view::Frame full_hd_frame(std::vector<scene::WorldLight> lights) {
  return frame_of(perspective(M_PI / 3, 16.0 / 9.0, 0.1, 400), k_full_hd, std::move(lights));
}

std::int64_t frustum_cell(const grid::Grid& grid, int x, int y, int z) {
  return cell_index(grid.cells(), x, y, z);
}

TEST(SphereRefinement, finds_the_light_that_is_lost_when_the_centre_row_is_not_taken_again) {
  const view::Frame frame = full_hd_frame({point_light({24.3343582, -12.6534967, -24.6891174}, 13)});
  const grid::Grid grid = grid_of(frustum_12x12x24(), frame);
  EXPECT_TRUE(lists_light(lists_by("sphere-refinement", frame, grid), frustum_cell(grid, 8, 10, 17), 0));
}

TEST(SphereRefinement, finds_the_light_that_a_fast_logarithm_loses_at_a_slice_boundary) {
  const view::Frame frame = full_hd_frame({point_light({-16.7833176, 14.3895569, -103.066628}, 3)});
  const grid::Grid grid = grid_of(frustum_12x12x24(), frame);
  // Published as row 7 from the bottom.
  EXPECT_TRUE(lists_light(lists_by("sphere-refinement", frame, grid), frustum_cell(grid, 5, 4, 19), 0));
}

TEST(SphereRefinement, stays_within_bounds_and_narrowing_within_both) {
  const view::Frame frame = full_hd_frame(random_lights(150, 150, 18));
  const grid::Grid grid = grid_of(frustum_12x12x24(), frame);
  const auto refined = [&](const char* spot) {
    return lists_by("sphere-refinement", frame, grid, {{"spot", std::string(spot)}});
  };
  for (const char* spot : {"sphere", "range", "cone-sphere", "both"})
    EXPECT_TRUE(contained(refined(spot), lists_by("bounds", frame, grid, {{"spot", std::string(spot)}}))) << spot;
  EXPECT_TRUE(contained(refined("both"), refined("sphere")));
  EXPECT_TRUE(contained(refined("narrowing"), refined("both")));
  EXPECT_LT(refined("narrowing").pair_count(), refined("both").pair_count());
}

TEST(SphereRefinement, holds_every_drawn_point_of_random_points_and_spots_in_every_spot_mode) {
  const view::Frame frame = full_hd_frame(random_lights(150, 150, 11));
  const grid::Grid grid = grid_of(frustum_12x12x24(), frame);
  for (const char* spot : {"sphere", "range", "cone-sphere", "both", "narrowing"})
    EXPECT_EQ(
        count_misses(frame, grid, lists_by("sphere-refinement", frame, grid, {{"spot", std::string(spot)}}), 2000, 12),
        0)
        << spot;
}

// By one plane a column is rejected only where the ball lies beyond it, so nothing is lost, and more is kept.
TEST(SphereRefinement, by_the_nearest_plane_of_each_column_lists_all_that_both_planes_list_and_more) {
  const view::Frame frame = full_hd_frame(random_lights(200, 100, 19));
  for (const char* spot : {"sphere", "cone-sphere"}) {
    const grid::Grid grid = grid_of(frustum_12x12x24(), frame);
    const Lists both = lists_by("sphere-refinement", frame, grid, {{"spot", std::string(spot)}});
    const Lists nearest =
        lists_by("sphere-refinement", frame, grid, {{"spot", std::string(spot)}, {"columns", std::string("nearest")}});
    EXPECT_TRUE(contained(both, nearest)) << spot;
    EXPECT_GT(nearest.pair_count(), both.pair_count()) << spot;
    EXPECT_LT(nearest.pair_count(), both.pair_count() * 5 / 4) << spot;
    EXPECT_EQ(count_misses(frame, grid, nearest, 2000, 20), 0) << spot;
  }
}

// The balls of their ranges: what the method lists for points in their places.
TEST(SphereRefinement, lists_spots_by_their_ranges_as_it_lists_points) {
  view::Frame spots = full_hd_frame(random_lights(0, 150, 21)), points = spots;
  for (scene::WorldLight& light : points.lights) light.type = scene::LightType::point;
  points.count_types();
  const grid::Grid grid = grid_of(frustum_12x12x24(), spots);
  for (const char* name : {"sphere-refinement", "sphere-refinement-fast", "bounds", "aabb-fast"}) {
    const Lists as_points = lists_by(name, points, grid);
    EXPECT_EQ(lists_by(name, spots, grid, {{"spot", std::string("range")}}), as_points) << name;
  }
}

TEST(SphereRefinement, holds_every_drawn_point_in_an_orthographic_view) {
  view::Projection projection{true, -40, 40, -22.5, 22.5, 0, 300};
  const view::Frame frame = frame_of(projection, k_full_hd, random_lights(150, 150, 13));
  grid::GridSpec spec = frustum_12x12x24();
  spec.slices.scheme = grid::Scheme::linear;
  spec.slices.near_m = 0.0;
  spec.slices.far_m = 300;
  const grid::Grid grid = grid_of(spec, frame);
  for (const char* spot : {"sphere", "narrowing"})
    EXPECT_EQ(
        count_misses(frame, grid, lists_by("sphere-refinement", frame, grid, {{"spot", std::string(spot)}}), 2000, 14),
        0)
        << spot;
}

TEST(SphereRefinement, holds_every_drawn_point_in_wide_narrow_and_off_centre_views_and_splinter_cells) {
  const double left = std::tan(-54 * M_PI / 180), right = std::tan(40 * M_PI / 180);
  const double top = std::tan(44 * M_PI / 180), bottom = std::tan(-55 * M_PI / 180);
  for (const view::Projection& projection :
       {perspective(1 * M_PI / 180, 1, 0.1, 400), perspective(179 * M_PI / 180, 1, 0.1, 400),
        view::Projection{false, left, right, bottom, top, 0.1, 400}})
    for (const Vec2i tiles : {Vec2i{1, 1}, Vec2i{60, 2}, Vec2i{2, 60}}) {
      const view::Frame frame = frame_of(projection, {1000, 1000}, random_lights(60, 60, 15));
      grid::GridSpec spec = frustum_12x12x24();
      spec.tiles.count = tiles;
      spec.slices.count = tiles.x == 1 ? 1 : 8;
      const grid::Grid grid = grid_of(spec, frame);
      EXPECT_EQ(count_misses(frame, grid, lists_by("sphere-refinement", frame, grid), 500, 16), 0);
    }
}

TEST(SphereRefinement, takes_what_an_unbounded_light_touches_and_skips_a_light_without_volume) {
  const double infinity = std::numeric_limits<double>::infinity();
  const view::Frame frame = full_hd_frame({point_light({0, 0, -10}, infinity), point_light({0, 0, -10}, 0),
                                           point_light({1, 1, -10}, 1e-4), point_light({0, 0, 1e6 + 5}, 1e6)});
  const grid::Grid grid = grid_of(frustum_12x12x24(), frame);
  const Lists lists = lists_by("sphere-refinement", frame, grid);
  std::uint32_t listed[4] = {};
  for (const std::uint32_t light : lists.lights) ++listed[light];
  EXPECT_EQ(listed[0], grid.cell_count());
  EXPECT_EQ(listed[1], 0u);
  EXPECT_GE(listed[2], 1u);
  EXPECT_LE(listed[2], 2u);
  // A ball that ends 5 m behind the eye: its padding, half a metre per million, does not reach the view.
  EXPECT_EQ(listed[3], 0u);
}

// The picture's sides lean away from the axis of such a spot by nearly 180 degrees: the sine of that decides.
TEST(SphereRefinement, keeps_spots_of_nearly_90_degrees_that_reach_a_wide_view_from_beside_it) {
  const double slope = 7000.0, range = 1e5;
  const view::Frame frame = frame_of(view::Projection{false, -slope, slope, -slope, slope, 4e-4, 2}, {64, 64},
                                     {spot_light({-range, 0, -9}, range, {0, 0, 1}, 1.5707963)});
  grid::GridSpec spec = frustum_12x12x24();
  spec.tiles.count = {1, 1};
  spec.slices.count = 1;
  const grid::Grid grid = grid_of(spec, frame);
  const Lists truth = lists_by("exact", frame, grid);
  ASSERT_EQ(truth.pair_count(), 1u);
  EXPECT_EQ(lists_by("sphere-refinement", frame, grid), truth);
  EXPECT_EQ(lists_by("sphere-refinement-fast", frame, grid), truth);
}

TEST(SphereRefinement, lists_each_light_on_both_sides_of_a_plane_that_it_touches) {
  std::vector<scene::WorldLight> lights;
  const view::Frame empty = full_hd_frame({});
  const grid::Grid grid = grid_of(frustum_12x12x24(), empty);
  const std::vector<float>& depths = grid.screen().slices.boundaries;
  Random random(17);
  for (std::size_t slice = 8; slice < depths.size() - 1; ++slice)
    for (const double side : {-1.0, 1.0}) {
      const double r = random.between(0.05, 0.4) * depths[slice];
      lights.push_back(point_light({0.013 * depths[slice], 0.017 * depths[slice], -(depths[slice] + side * r)}, r));
    }
  const view::Frame frame = full_hd_frame(lights);
  const Lists lists = lists_by("sphere-refinement", frame, grid);
  for (std::uint32_t light = 0; light < lights.size(); ++light) {
    const int beyond = 8 + static_cast<int>(light / 2);
    const int column = interval_of(grid.screen().tiles.x, 0.013), row = interval_of(grid.screen().tiles.y, 0.017);
    EXPECT_TRUE(lists_light(lists, frustum_cell(grid, column, row, beyond), light)) << "light " << light;
    EXPECT_TRUE(lists_light(lists, frustum_cell(grid, column, row, beyond - 1), light)) << "light " << light;
  }
}

}  // namespace
}  // namespace clusterbench::assign::testing
