// Slices of each tile's own: where they lie, that the lookup finds them, and that nothing in the view is lost.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "assign/contract/assigner_run.h"
#include "assign/settings.h"
#include "effort.h"
#include "measure/samples/samples.h"
#include "measure/samples/shading.h"
#include "view/packing.h"

namespace clusterbench::measure {
namespace {

using assign::testing::Setting;

const assign::AssignerDescriptor& tile_slices() {
  return *assign::find_assigner("tile-slices");
}

assign::AssignerRun sliced(const Setting& setting) {
  assign::AssignerRun run(tile_slices(), assign::Params(tile_slices().params), assign::Answer::structure);
  run.build(setting.grid);
  run.assign(setting.input(view::lights_in(setting.frame, setting.frame.view_space)));
  return run;
}

// Two tiles side by side, from 1 m to 101 m in `slices`; the left one shows a wall at `depth`, the right one sky.
Setting wall_and_sky(float depth, int slices) {
  Setting setting;
  setting.frame.viewport = {20, 10};
  setting.frame.projection = {false, -1, 1, -0.5, 0.5, 1, 101};
  grid::GridSpec spec;
  spec.tiles = {{0, 0}, {2, 1}};
  spec.slices.scheme = grid::Scheme::linear;
  spec.slices.count = slices;
  spec.slices.near_m = 1;
  spec.slices.far_m = 101;
  setting.grid = grid::make_grid(spec, grid::grid_inputs(spec, setting.frame, 0.0, {}, {}));
  setting.depth = {depth::PixelGrid(setting.frame.viewport, 1),
                   std::vector<float>(200, std::numeric_limits<float>::infinity())};
  for (std::size_t i = 0; i < 200; i += 20) setting.depth.nearest[i] = depth;
  return setting;
}

// Where the slices of a tile begin, and where the last one ends.
std::vector<float> begins_of(const assign::AssignerRun& run, std::uint32_t tile) {
  const grid::OccupiedCells cells = run.structure()->occupied_cells();
  std::vector<float> begins;
  for (std::uint32_t cell = tile; cell < cells.cell_count(); cell += 2) {
    EXPECT_EQ(cells.of(cell).size(), 1u);
    begins.push_back(cells.of(cell)[0].depth0);
    if (cell + 2 >= cells.cell_count()) begins.push_back(cells.of(cell)[0].depth1);
  }
  return begins;
}

TEST(TileSlices, half_of_them_lie_in_front_of_the_farthest_pixel_and_each_is_thicker_than_the_one_before_it) {
  const std::vector<float> begins = begins_of(sliced(wall_and_sky(11.0f, 8)), 0);
  ASSERT_EQ(begins.size(), 9u);
  EXPECT_EQ(begins.front(), 1.0f);
  EXPECT_NEAR(begins[4], 11.0, 1e-3);
  EXPECT_EQ(begins.back(), 101.0f);
  // A tenth of the range: growth^4 = (1 - 0.1) / 0.1.
  for (std::size_t i = 1; i + 1 < begins.size(); ++i)
    EXPECT_NEAR((begins[i + 1] - begins[i]) / (begins[i] - begins[i - 1]), std::sqrt(3.0), 1e-3) << i;
}

TEST(TileSlices, of_sky_or_of_far_walls_grow_least) {
  for (const auto& [depth, tile] : {std::pair(11.0f, 1u), std::pair(90.0f, 0u)}) {
    const std::vector<float> begins = begins_of(sliced(wall_and_sky(depth, 8)), tile);
    EXPECT_NEAR((begins[2] - begins[1]) / (begins[1] - begins[0]), 1.02, 1e-3);
  }
}

TEST(TileSlices, a_wall_before_the_eye_or_at_its_near_plane_leaves_slices_too) {
  for (const float depth : {1.0f, 1.00001f, 101.0f}) {
    const std::vector<float> begins = begins_of(sliced(wall_and_sky(depth, 64)), 1);
    EXPECT_EQ(begins.size(), 65u);
    const grid::OccupiedCells cells = sliced(wall_and_sky(depth, 64)).structure()->occupied_cells();
    for (const geom::FrustumCell& part : cells.parts) EXPECT_LT(part.depth0, part.depth1);
  }
}

TEST(TileSlices, a_sample_gets_the_lights_of_the_cell_whose_part_holds_its_depth) {
  std::uint64_t lights = 0;
  for (const Setting& setting : assign::testing::settings_for(tile_slices(), 61)) {
    const assign::AssignerRun run = sliced(setting);
    const grid::OccupiedCells cells = run.structure()->occupied_cells();
    const assign::Lists lists = run.structure()->expanded();
    const auto tiles = static_cast<std::uint32_t>(cells.counts.x * cells.counts.y);
    std::vector<std::uint32_t> given;
    for (const grid::Sample& sample : volume_samples(setting.frame, 500.0, 2000, 5)) {
      if (!run.structure()->lights_at(sample, grid::Log2::rounded, given)) continue;
      const Vec2i at = setting.grid.screen().tiles.tile_of(sample.pixel_x, sample.pixel_y);
      const float depth = -sample.view.z;
      int found = 0;
      for (auto cell = static_cast<std::uint32_t>(at.y * cells.counts.x + at.x); cell < cells.cell_count();
           cell += tiles)
        for (const geom::FrustumCell& part : cells.of(cell)) {
          if (!(depth >= part.depth0 && (depth < part.depth1 || cell + tiles >= cells.cell_count()))) continue;
          ++found;
          EXPECT_TRUE(std::ranges::equal(lists.of(cell), given)) << setting.name << " at " << depth;
        }
      EXPECT_EQ(found, 1) << setting.name << " at " << depth;
      lights += given.size();
    }
  }
  EXPECT_GT(lights, 10000u);
}

TEST(TileSlices, lose_nothing_at_surfaces_or_in_the_air) {
  for (int i = 0; i < test::tries(3); ++i)
    for (const Setting& setting : assign::testing::settings_for(tile_slices(), 62 + static_cast<std::uint64_t>(i))) {
      const assign::AssignerRun run = sliced(setting);
      ShadingCounts counts;
      for (const std::vector<grid::Sample>& samples :
           {volume_samples(setting.frame, 500.0, 4000, 7), opaque_samples(setting.frame, setting.depth)}) {
        const std::span<const grid::Sample> some(samples.data(), std::min<std::size_t>(samples.size(), 4000));
        add_samples(counts, 0, some, needed_lights(setting.frame, some), *run.structure());
      }
      EXPECT_EQ(counts.missed, counts.missed_outside) << setting.name;
      EXPECT_GT(counts.needed, 1000u) << setting.name;
    }
}

}  // namespace
}  // namespace clusterbench::measure
