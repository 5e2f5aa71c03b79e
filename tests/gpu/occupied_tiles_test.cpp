// Lights tested against the tiles with a surface alone, by an indirect dispatch: all is as with a group for each tile.

#include <bit>
#include <cmath>

#include "core/arrays.h"
#include "gpu/device_test.h"
#include "gpu/methods/frame_arguments.h"
#include "gpu/structure_runs.h"

namespace clusterbench::gpu {
namespace {

using assign::AssignerRun;
using assign::Params;
using assign::testing::Setting;
using testing::Values;

using DeviceOccupiedTiles = testing::DeviceTest;

constexpr float k_sky = INFINITY;

Values with_tiles(Values values, const char* tiles) {
  values["tiles"] = std::string(tiles);
  return values;
}

void expect_same_frame(const AssignerRun& found, const AssignerRun& expected, const std::string& where) {
  testing::expect_same_cells(*found.structure(), *expected.structure(), where);
  EXPECT_TRUE(found.structure()->expanded() == expected.structure()->expanded()) << where;
  const assign::StructureUse use = found.structure()->use(), wanted = expected.structure()->use();
  EXPECT_EQ(use.index_entries, wanted.index_entries) << where;
  EXPECT_EQ(use.header_bytes, wanted.header_bytes) << where;
  EXPECT_EQ(found.tests_done(), expected.tests_done()) << where;
}

// Every n-th row of pixels is left; 0: none.
Setting with_sky(Setting setting, int nth) {
  const auto width = static_cast<std::size_t>(setting.frame.viewport.x);
  for (std::size_t pixel = 0; pixel < setting.depth.nearest.size(); ++pixel)
    if (nth == 0 || pixel / width % static_cast<std::size_t>(nth) != 0) setting.depth.nearest[pixel] = k_sky;
  return setting;
}

TEST_F(DeviceOccupiedTiles, have_the_lists_of_all_tiles) {
  std::uint64_t pairs = 0;
  std::size_t turn = 0;
  const std::vector<std::string> spots{"both", "cone-sphere", "sphere"};
  for (const Setting& given : testing::settings_of_tiles(21))
    for (const std::string test : {"planes", "aabb", "both"})
      for (const bool is_masked : {false, true}) {
        const Setting setting = turn % 2 == 0 ? given : with_sky(given, 200);
        const Values values{{"test", test}, {"depth_mask", is_masked}, {"spot", spots[turn++ % spots.size()]}};
        const auto run = [&](const char* tiles) {
          return testing::run_of("gpu-tiled", with_tiles(values, tiles), assign::Answer::structure, setting);
        };
        const AssignerRun expected = run("all");
        expect_same_frame(run("occupied"), expected, setting.name + ", " + test + (is_masked ? ", masked" : ""));
        pairs += expected.structure()->use().index_entries;
      }
  EXPECT_GT(pairs, 1000u);
}

// Whatever the frame before left: pictures with more and fewer tiles, wholly sky, without lights. Of 144 tiles: what is
// written behind the last one's place is beyond the buffer.
TEST_F(DeviceOccupiedTiles, are_those_of_each_frame_anew) {
  const assign::AssignerDescriptor& row = *assign::find_assigner("gpu-tiled");
  const Setting full = assign::testing::settings_for(row, 9).front(), few = with_sky(full, 200),
                none = with_sky(full, 0);
  Setting dark = full;
  dark.frame.lights.clear();
  dark.frame.count_types();
  const std::pair<const char*, const Setting*> frames[] = {{"none", &none}, {"full", &full}, {"full", &full},
                                                           {"dark", &dark}, {"few", &few},   {"dark", &dark},
                                                           {"dark", &dark}, {"none", &none}, {"full", &full}};
  const auto kinds = assign::kinds_of(testing::lights_of(full));
  AssignerRun run(row, Params(row.params, with_tiles({}, "occupied")), assign::Answer::structure);
  run.build(full.grid, kinds);
  for (const auto& [name, setting] : frames) {
    AssignerRun expected(row, Params(row.params, with_tiles({}, "all")), assign::Answer::structure);
    expected.build(full.grid, kinds);
    const view::LightArrays lights = testing::lights_of(*setting);
    run.assign(setting->input(lights));
    expected.assign(setting->input(lights));
    expect_same_frame(run, expected, name);
    EXPECT_EQ(run.structure()->use().index_entries > 0, setting == &full || setting == &few) << name;
  }
}

// 210 x 158 tiles of a pixel each, of which the last one has no surface; lights near the lower edge of the picture.
Setting of_33180_tiles() {
  Setting setting;
  setting.name = "33,180 tiles";
  std::vector<scene::WorldLight> lights;
  for (int i = 0; i < 20; ++i) lights.push_back(assign::testing::point_light({i % 10 - 5, i / 10 - 6, -6}, 1.5));
  setting.frame = assign::testing::frame_of({false, -1, 1, -1, 1, 1, 100}, {210, 158}, std::move(lights));
  grid::GridSpec spec;
  spec.tiles = {{1, 1}, {0, 0}};
  spec.slices = {.scheme = grid::Scheme::exponential, .count = 2, .near_m = 1, .far_m = 100, .boundaries_m = {}};
  setting.grid = assign::testing::grid_of(spec, setting.frame);
  setting.depth.pixels = depth::PixelGrid(setting.frame.viewport, 1);
  setting.depth.nearest.assign(setting.depth.pixels.count(), 6.0f);
  setting.depth.nearest.back() = k_sky;
  return setting;
}

TEST_F(DeviceOccupiedTiles, may_be_more_than_a_row_of_groups) {
  const Setting setting = of_33180_tiles();
  const auto run = [&](const char* tiles) {
    return testing::run_of("gpu-tiled", with_tiles({}, tiles), assign::Answer::structure, setting);
  };
  const AssignerRun found = run("occupied"), expected = run("all");
  expect_same_frame(found, expected, setting.name);
  EXPECT_EQ(found.structure()->occupied_cells().parts.size(), 33'179u);
  EXPECT_GT(found.structure()->expanded().of(33'000).size(), 0u) << "a tile of the second row of groups";
}

// What the shader appends for a row of tiles of a pixel each.
std::vector<std::uint32_t> queue_of(const std::vector<float>& depths) {
  const auto tiles = static_cast<std::uint32_t>(depths.size());
  std::vector<std::uint32_t> sides;
  for (std::uint32_t i = 0; i <= tiles; ++i)
    sides.insert(sides.end(), {std::bit_cast<std::uint32_t>(static_cast<float>(i)), 0, 0, i});
  for (std::uint32_t row = 0; row < 2; ++row)
    sides.insert(sides.end(), {std::bit_cast<std::uint32_t>(1.0f - static_cast<float>(row)), 0, 0, row});
  FrameArguments arguments;
  arguments.cells = arguments.columns = arguments.picture_width = tiles;
  arguments.rows = arguments.slices = 1;
  Buffers buffers(device());
  buffers.reserve(Binding::depths, bytes_of(depths), "depths");
  buffers.reserve(Binding::tile_sides, bytes_of(sides), "sides");
  buffers.reserve(Binding::tiles, 64 * std::uint64_t{tiles}, "tiles");
  buffers.reserve(Binding::tile_queue, 16 + 4 * std::uint64_t{tiles}, "tiles with a surface");
  Commands commands(device(), buffers);
  commands.upload(Binding::depths, depths.data(), bytes_of(depths));
  commands.upload(Binding::tile_sides, sides.data(), bytes_of(sides));
  commands.fill(Binding::tile_queue, 0, 16);
  commands.barrier();
  constexpr std::uint32_t k_appends = 4;
  commands.dispatch(device().kernel("tile_depths", 2, k_appends), arguments, tiles);
  commands.download(Binding::tile_queue, 16 + 4 * std::uint64_t{tiles});
  commands.run();
  const auto words = commands.downloaded(0);
  return {words.begin(), words.end()};
}

TEST_F(DeviceOccupiedTiles, are_appended_once_each_with_groups_for_all_and_no_row_more) {
  for (const std::uint32_t count : {0u, 1u, 2u, 32'767u, 32'768u, 32'769u, 40'000u}) {
    std::vector<float> depths(40'000, k_sky);
    for (std::uint32_t i = 0; i < count; ++i) depths[std::uint64_t{i} * depths.size() / count] = 5.0f;
    std::vector<std::uint32_t> words = queue_of(depths);
    const std::uint32_t rows = (count + 32'767) / 32'768;
    EXPECT_EQ(std::vector<std::uint32_t>(words.begin(), words.begin() + 4),
              (std::vector<std::uint32_t>{std::min(count, 32'768u), rows, count > 0 ? 1u : 0u, count}));
    std::sort(words.begin() + 4, words.begin() + 4 + count);
    std::uint32_t place = 4;
    for (std::uint32_t tile = 0; tile < depths.size(); ++tile)
      if (depths[tile] != k_sky) {
        ASSERT_EQ(words[place++], tile) << count;
      }
  }
}

}  // namespace
}  // namespace clusterbench::gpu
