// The device's own lookup of a sample's cell: equal to the host's but for samples so near to a boundary that the error
// of a logarithm, a root or a division decides.

#include <gtest/gtest.h>

#include <iostream>

#include "effort.h"
#include "gpu/reading/reading_check.h"
#include "gpu/reading_scenes.h"

namespace clusterbench::gpu {
namespace {

using assign::LookedUp;
using assign::testing::Setting;

class DeviceReadingLookups : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string obstacle = device_obstacle(); !obstacle.empty()) GTEST_SKIP() << "skipped: " << obstacle;
  }
};

// Settings of every kind of grid, and a frustum grid whose slices are searched.
std::vector<Setting> lookup_settings() {
  std::vector<Setting> all;
  for (const char* method : {"exact", "distance", "cascades", "world-grid"})
    for (Setting& setting : assign::testing::settings_for(testing::method_named(method), 11))
      all.push_back(std::move(setting));
  Setting searched = all.front();
  grid::GridSpec spec =
      assign::testing::settings::screen_spec(grid::Kind::frustum, {16, 9}, grid::Scheme::power, 30, 0.1);
  searched.name = "slices that are searched";
  searched.grid = assign::testing::grid_of(spec, searched.frame);
  all.push_back(std::move(searched));
  return all;
}

// Samples a few ulps beside the boundaries of slices: there a logarithm decides. None in a grid without slices.
std::vector<grid::Sample> beside_boundaries(const Setting& setting) {
  std::vector<grid::Sample> samples;
  if (!setting.grid.has_tiles()) return samples;
  for (const float boundary : setting.grid.screen().slices.boundaries)
    for (int step = -20; step <= 20; ++step) {
      const double depth = static_cast<double>(boundary) * (1.0 + step * 0x1p-23);
      const Vec2d pixel{0.5 * setting.frame.viewport.x + step * 7.25, 0.5 * setting.frame.viewport.y - step * 5.5};
      samples.push_back(testing::sample_at(setting.frame, pixel, depth));
    }
  return samples;
}

// What samples that read nothing else look up: any structure on the grid has it.
testing::Held bits_of(const Setting& setting) {
  const view::LightArrays lights = view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame));
  testing::Held held{setting.name, lights, nullptr, nullptr};
  const assign::StorageDescriptor& storage = *assign::find_storage("bitfield");
  held.storage = storage.make(assign::Params(storage.params));
  held.storage->start(setting.grid, held.lights);
  return held;
}

TEST_F(DeviceReadingLookups, find_the_cells_of_the_host_or_are_off_by_what_a_logarithm_may_be) {
  std::uint64_t differing = 0, all = 0;
  for (const Setting& setting : lookup_settings()) {
    const testing::Held held = bits_of(setting);
    ReadingStructure structure(held.structure(), setting.grid, held.lights);
    const std::vector<grid::Sample> anywhere = testing::points_anywhere(setting.frame, test::tries(40000), 17);
    ReadingSamples samples(anywhere, in_given_order(anywhere.size()), setting.grid);
    const LookupDifferences found = check_lookup(structure, samples);
    EXPECT_EQ(found.unexplained, 0u) << setting.name << ": " << found.first;
    EXPECT_EQ(found.samples, anywhere.size());
    EXPECT_LE(found.differing * 1000, found.samples) << setting.name;
    differing += found.differing;
    all += found.samples;
  }
  RecordProperty("differing", std::to_string(differing));
  std::cout << differing << " of " << all << " samples find another cell than on the host\n";
}

TEST_F(DeviceReadingLookups, beside_boundaries_are_off_by_what_a_logarithm_may_be) {
  std::uint64_t differing = 0, all = 0;
  for (const Setting& setting : lookup_settings()) {
    const std::vector<grid::Sample> beside = beside_boundaries(setting);
    if (beside.empty()) continue;
    const testing::Held held = bits_of(setting);
    ReadingStructure structure(held.structure(), setting.grid, held.lights);
    ReadingSamples samples(beside, in_given_order(beside.size()), setting.grid);
    const LookupDifferences found = check_lookup(structure, samples);
    EXPECT_EQ(found.unexplained, 0u) << setting.name << ": " << found.first;
    differing += found.differing;
    all += found.samples;
  }
  std::cout << differing << " of " << all << " samples beside boundaries find another cell than on the host\n";
}

// --- What is allowed: on the host alone ---

Setting frustum_setting() {
  return assign::testing::settings_for(testing::method_named("exact"), 11).front();
}

TEST(ReadingLookup, allows_a_neighbouring_slice_at_a_boundary_alone) {
  const Setting setting = frustum_setting();
  const grid::ScreenGrid& grid = setting.grid.screen();
  const std::int64_t tiles = grid.tiles.count.x * grid.tiles.count.y;
  const Vec2d pixel = Vec2d(setting.frame.viewport) / 2.0 + 0.25;
  for (std::size_t slice = 2; slice + 2 < grid.slices.boundaries.size(); ++slice) {
    const auto near = static_cast<double>(grid.slices.boundaries[slice]);
    const auto far = static_cast<double>(grid.slices.boundaries[slice + 1]);
    const grid::Sample middle = testing::sample_at(setting.frame, pixel, (near + far) / 2.0);
    const std::int64_t cell = cell_on_host(setting.grid, LookedUp::cell, middle);
    EXPECT_EQ(cell / tiles, static_cast<std::int64_t>(slice));
    const auto allows = [&](const grid::Sample& sample, std::int64_t found, bool rounds = true) {
      return may_find(setting.grid, LookedUp::cell, sample, found, rounds);
    };
    EXPECT_TRUE(allows(middle, cell));
    for (const std::int64_t other : {cell - tiles, cell + tiles, cell - 1, cell + 1, std::int64_t{-1}})
      for (const bool rounds : {true, false}) EXPECT_FALSE(allows(middle, other, rounds)) << slice;
    const grid::Sample at_boundary = testing::sample_at(setting.frame, pixel, near);
    EXPECT_TRUE(allows(at_boundary, cell) && allows(at_boundary, cell - tiles)) << slice;
    EXPECT_FALSE(allows(at_boundary, cell + tiles) || allows(at_boundary, cell - 2 * tiles));
  }
  const grid::Sample beyond = testing::sample_at(setting.frame, pixel, 400.0);
  EXPECT_TRUE(may_find(setting.grid, LookedUp::cell, beyond, -1, true));
  EXPECT_FALSE(may_find(setting.grid, LookedUp::cell, beyond, 0, true));
}

TEST(ReadingLookup, allows_a_neighbouring_box_at_a_side_alone) {
  const Setting setting = assign::testing::settings_for(testing::method_named("cascades"), 11).front();
  const grid::CascadesGrid& grid = setting.grid.cascades();
  const double edge = static_cast<double>(grid.edge_m(0));
  const auto sample_in = [&](double x, double y, double z) {
    grid::Sample sample{};
    sample.view = {static_cast<float>((x - grid.cells.x / 2) * edge), static_cast<float>((grid.cells.y / 2 - y) * edge),
                   static_cast<float>(-z * edge)};
    return sample;
  };
  const auto cell_of = [&](Vec3i at) { return std::int64_t{grid::cell_index(at, grid.counts())}; };
  const auto allows = [&](const grid::Sample& sample, std::int64_t cell) {
    return may_find(setting.grid, LookedUp::cell, sample, cell, true);
  };
  const grid::Sample inside = sample_in(3.5, 2.5, 1.5), at_side = sample_in(3.0, 2.5, 1.5);
  EXPECT_EQ(cell_on_host(setting.grid, LookedUp::cell, inside), cell_of({3, 2, 1}));
  EXPECT_TRUE(allows(inside, cell_of({3, 2, 1})));
  EXPECT_FALSE(allows(inside, cell_of({2, 2, 1})) || allows(inside, cell_of({3, 2, 9})) || allows(inside, -1));
  EXPECT_TRUE(allows(at_side, cell_of({3, 2, 1})) && allows(at_side, cell_of({2, 2, 1})));
  EXPECT_FALSE(allows(at_side, cell_of({4, 2, 1})) || allows(at_side, -1));
  const grid::Sample behind = sample_in(3.5, 2.5, -2.0);
  EXPECT_TRUE(allows(behind, -1));
  EXPECT_FALSE(allows(behind, cell_of({3, 2, 0})));
}

}  // namespace
}  // namespace clusterbench::gpu
