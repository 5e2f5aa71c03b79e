// Columns per row of tiles, held against the exact method on a grid whose slices are one.

#include "assign/contract.h"
#include "assign/dense_check.h"

namespace clusterbench::assign::testing {
namespace {

// The lists of a tile are then the bits of its mask.
grid::Grid with_one_slice(const grid::Grid& grid) {
  grid::ScreenGrid screen = grid.screen();
  screen.slices.boundaries = {screen.slices.boundaries.front(), screen.slices.boundaries.back()};
  screen.slices.lookup = {};
  return {screen};
}

struct PairCounts {
  std::uint64_t points = 0, spots = 0;
};

PairCounts counted(const Lists& lists, const view::Frame& frame) {
  PairCounts counts;
  for (const std::uint32_t light : lists.lights) ++(light < frame.points ? counts.points : counts.spots);
  return counts;
}

TEST(TileSpans, have_the_tiles_that_points_reach_and_no_others) {
  for (const std::uint64_t seed : {1u, 2u, 3u})
    for (const Setting& setting : settings_for(*find_assigner("exact"), seed)) {
      const grid::Grid grid = with_one_slice(setting.grid);
      const Lists exact = lists_by("exact", setting.frame, grid), spans = lists_by("tile-spans", setting.frame, grid);
      EXPECT_TRUE(contained(exact, spans)) << setting.name;
      const PairCounts truth = counted(exact, setting.frame), found = counted(spans, setting.frame);
      EXPECT_LE(static_cast<double>(found.points), 1.002 * static_cast<double>(truth.points)) << setting.name;
    }
}

TEST(TileSpans, have_a_quarter_of_the_excess_tiles_of_spots_that_the_boxes_of_z_binning_have) {
  for (const Setting& setting : settings_for(*find_assigner("exact"), 4)) {
    const grid::Grid grid = with_one_slice(setting.grid);
    const PairCounts truth = counted(lists_by("exact", setting.frame, grid), setting.frame);
    const PairCounts spans = counted(lists_by("tile-spans", setting.frame, grid), setting.frame);
    const PairCounts boxes = counted(lists_by("z-binning", setting.frame, grid), setting.frame);
    EXPECT_LE(4 * (spans.spots - truth.spots), boxes.spots - truth.spots) << setting.name;
    EXPECT_GE(spans.spots, truth.spots) << setting.name;
  }
}

// A bit of the tile and one of the bin, in place of a bit of the tile between the bin's first and last light.
TEST(TileSpans, with_masks_of_bins_give_a_sample_the_lights_that_its_tile_and_its_bin_have_in_common) {
  for (const Setting& setting : settings_for(*find_assigner("exact"), 5)) {
    const Lists ranges = lists_by("tile-spans", setting.frame, setting.grid);
    const Lists masks = lists_by("tile-spans", setting.frame, setting.grid, {{"bins", std::string("masks")}});
    EXPECT_TRUE(contained(lists_by("exact", setting.frame, setting.grid), masks)) << setting.name;
    // By hand: of each slice the lights of all its cells whose depths reach it.
    const Vec3i cells = setting.grid.cells();
    const view::LightArrays lights = view::lights_in(setting.frame, setting.frame.view_space);
    const std::vector<float>& depths = setting.grid.screen().slices.boundaries;
    for (std::uint32_t cell = 0; cell < ranges.cell_count(); ++cell) {
      const auto z = static_cast<std::size_t>(setting.grid.cell_at(cell).z);
      for (const std::uint32_t light : masks.of(cell)) {
        const geom::Ball ball = lights.ball(light, 64.0f);
        EXPECT_TRUE(-ball.center.z - ball.radius <= depths[z + 1] && -ball.center.z + ball.radius >= depths[z])
            << setting.name << " " << cell << " of " << cells.z << " slices: light " << light;
      }
    }
    EXPECT_LE(masks.pair_count(), ranges.pair_count()) << setting.name;
  }
}

// A narrow beam across the picture: its balls cover most of the tiles, its outline few.
TEST(TileSpans, follow_the_sides_of_a_beam) {
  const view::Projection projections[] = {perspective(1.0, 16.0 / 9.0, 0.1, 100), {true, -16, 16, -9, 9, 0.1, 100}};
  for (const view::Projection& projection : projections) {
    const Vec3d apex{-7, -3, -12};
    const view::Frame frame = frame_of(projection, {1280, 720}, {spot_light(apex, 14.0, Vec3d{14, 6, -1}, 0.03)});
    grid::GridSpec spec;
    spec.tiles = {{32, 32}, {0, 0}};
    spec.slices = {.scheme = grid::Scheme::linear, .count = 1, .near_m = 0.1, .far_m = 100.0, .boundaries_m = {}};
    const grid::Grid grid = grid_of(spec, frame);
    const Lists exact = lists_by("exact", frame, grid), spans = lists_by("tile-spans", frame, grid);
    EXPECT_TRUE(contained(exact, spans));
    EXPECT_GT(exact.pair_count(), 10u);
    EXPECT_LE(4 * spans.pair_count(), 5 * exact.pair_count());
    EXPECT_GE(lists_by("z-binning", frame, grid).pair_count(), 2 * exact.pair_count());
  }
}

}  // namespace
}  // namespace clusterbench::assign::testing
