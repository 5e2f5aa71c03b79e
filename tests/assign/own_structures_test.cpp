// Light structures that are not made from lists, by hand.

#include <gtest/gtest.h>

#include <tuple>

#include "assign/bounds/ball_boxes.h"
#include "assign/contract/assigner_run.h"
#include "assign/each_target.h"
#include "assign/lists/radix_sort.h"
#include "assign/settings.h"
#include "geom/single_precision/touch_tests.h"

namespace clusterbench::assign {
namespace {

using testing::point_light;
using testing::spot_light;

// Two tiles side by side, x < 0 and x > 0, and slices from 1 to 2, 4, 8, 16 m.
struct TwoTiles {
  view::Frame frame;
  grid::Grid grid;

  explicit TwoTiles(const std::vector<scene::WorldLight>& lights) {
    frame.viewport = {200, 100};
    frame.projection = {false, -1, 1, -1, 1, 1, 16};
    frame.lights = lights;
    for (const scene::WorldLight& light : lights) frame.points += light.type == scene::LightType::point ? 1 : 0;
    grid::GridSpec spec;
    spec.tiles = {{0, 0}, {2, 1}};
    spec.slices = {.scheme = grid::Scheme::list, .boundaries_m = {1, 2, 4, 8, 16}};
    grid = grid::make_grid(spec, grid::grid_inputs(spec, frame, 0.0, {}, {}));
  }
  AssignerRun run(const char* name) const {
    const AssignerDescriptor& assigner = *find_assigner(name);
    AssignerRun made(assigner, Params(assigner.params), Answer::structure);
    made.build(grid);
    made.assign({frame, view::lights_in(frame, frame.view_space)});
    return made;
  }
};

std::vector<std::uint32_t> at(const AssignerRun& run, float pixel_x, const Vec3f& place) {
  std::vector<std::uint32_t> lights;
  run.structure()->lights_at({pixel_x, 50.0f, place, Vec3d(place), Vec3d(0.0)}, grid::Log2::rounded, lights);
  return lights;
}

Reads reads_at(const AssignerRun& run, float pixel_x, const Vec3f& place) {
  return run.structure()->reads_at({pixel_x, 50.0f, place, Vec3d(place), Vec3d(0.0)}, grid::Log2::rounded);
}

TEST(ZBinning, a_sample_reads_its_bin_the_words_of_its_range_and_a_number_for_each_light) {
  // 40 lights by depth at 3 m, 40 at 6 m, a spot at 12 m: ranks 0 to 39, 40 to 79, 80; words of 32.
  std::vector<scene::WorldLight> lights;
  for (int i = 0; i < 80; ++i) lights.push_back(point_light({1, 0, i < 40 ? -3 : -6}, 0.5));
  lights.push_back(spot_light({1, 0, -12}, 0.5, {0, 0, -1}, 0.4));
  const TwoTiles two(lights);
  const AssignerRun bins = two.run("z-binning"), ranges = two.run("tile-ranges");
  EXPECT_EQ(reads_at(bins, 150, {0.5f, 0, -1.5f}), (Reads{1, 16})) << "an empty bin";
  EXPECT_EQ(reads_at(bins, 150, {1, 0, -3}), (Reads{1 + 2 + 40, 16 + 4 * (2 + 40)}));
  EXPECT_EQ(reads_at(bins, 150, {1, 0, -6}), (Reads{1 + 2 + 40, 16 + 4 * (2 + 40)}));
  EXPECT_EQ(reads_at(bins, 150, {1, 0, -12}), (Reads{1 + 1 + 1, 16 + 4 * (1 + 1)}));
  EXPECT_EQ(reads_at(bins, 50, {-1, 0, -6}), (Reads{1 + 2, 16 + 4 * 2})) << "words without a bit of this tile";
  EXPECT_EQ(reads_at(ranges, 50, {-1, 0, -6}), (Reads{1, 8})) << "a range of its own says so";
  EXPECT_EQ(reads_at(bins, 150, {9, 0, -20}), Reads{}) << "beyond the grid";
}

TEST(Bvh, a_sample_reads_the_boxes_of_the_groups_on_its_way_and_a_number_for_each_light) {
  std::vector<scene::WorldLight> lights;
  for (int i = 0; i < 100; ++i) lights.push_back(point_light({3.0 * i, 0, -6}, 1.0));
  lights.push_back(spot_light({30, 0, -5}, 4.0, {0, 0, -1}, 0.4));
  const AssignerRun run = TwoTiles(lights).run("bvh");
  // Three levels of points and one of spots: a group of eight boxes in each.
  EXPECT_EQ(reads_at(run, 150, {4.5f, 0, -6}), (Reads{32, 24 * 32}));
  EXPECT_EQ(reads_at(run, 150, {3, 0, -6}), (Reads{32 + 1, 24 * 32 + 4}));
  EXPECT_EQ(reads_at(run, 150, {297, 0, 6}), (Reads{16, 24 * 16})) << "behind all of them: the uppermost groups";
}

TEST(ZBinning, a_sample_gets_its_tiles_bits_within_its_bins_range) {
  // From back to front 0, 1, 2 on the right, 3 a spot on the left; sorted by depth 2, 1, 0, and 3.
  const TwoTiles two({point_light({5, 0, -12}, 1.0), point_light({3, 0, -6}, 0.5), point_light({1, 0, -3}, 0.25),
                      spot_light({-3, 0, -6}, 0.5, {0, 0, -1}, 0.4)});
  const AssignerRun run = two.run("z-binning");
  using Lights = std::vector<std::uint32_t>;
  EXPECT_EQ(at(run, 150, {0.5f, 0, -1.5f}), Lights());
  EXPECT_EQ(at(run, 150, {1, 0, -3}), Lights{2});
  EXPECT_EQ(at(run, 150, {3, 0, -6}), Lights{1});
  EXPECT_EQ(at(run, 150, {5, 0, -12}), Lights{0});
  EXPECT_EQ(at(run, 50, {-3, 0, -6}), Lights{3});
  EXPECT_EQ(at(run, 50, {-1, 0, -3}), Lights());
  EXPECT_EQ(at(run, 150, {9, 0, -20}), Lights()) << "beyond the grid";
  const StructureUse use = run.structure()->use();
  EXPECT_EQ(use.index_entries, 2u) << "a word for each tile";
  EXPECT_EQ(use.header_bytes, 4u * 16u + 4u * 4u) << "two ranges for each bin, a number for each light";
}

TEST(ZBinning, lists_what_lies_between_the_first_and_the_last_of_a_bin) {
  // Sorted by their middles 1, 2, 0; the first and the last are large and reach the bin from 4 to 8 m, 2 is small.
  const TwoTiles two({point_light({2, 0, -6}, 5.0), point_light({2, 0, -3}, 3.0), point_light({2, 0, -3.5}, 0.25)});
  const AssignerRun run = two.run("z-binning");
  std::vector<std::uint32_t> lights = at(run, 150, {4, 0, -7});
  EXPECT_EQ(lights, (std::vector<std::uint32_t>{1, 2, 0})) << "by depth";
}

TEST(ZBinning, leaves_out_lights_beside_the_view_and_keeps_words_for_the_others) {
  std::vector<scene::WorldLight> lights;
  for (int i = 0; i < 100; ++i) lights.push_back(point_light({i < 33 ? 2.0 : 300.0, 0, -6}, 1.0));
  const AssignerRun run = TwoTiles(lights).run("z-binning");
  EXPECT_EQ(run.structure()->use().index_entries, 2u * 2u);
  EXPECT_EQ(run.structure()->limit().index_entries, 2u * 4u);
}

// Name, bytes of an element, elements, most, step.
using Needs = std::vector<std::tuple<std::string, std::uint32_t, std::uint64_t, std::uint64_t, std::uint64_t>>;

Needs needs_of(const LightStructure& structure) {
  Needs needs;
  std::uint64_t bytes = 0, most = 0;
  for (const BufferNeed& need : structure.buffers()) {
    needs.emplace_back(need.name, need.element_bytes, need.elements, need.most, need.step);
    bytes += need.element_bytes * need.elements;
    most += need.element_bytes * need.most;
  }
  EXPECT_EQ(bytes, structure.use().index_bytes + structure.use().header_bytes);
  EXPECT_EQ(most, structure.limit().bytes);
  return needs;
}

TEST(OwnStructures, say_what_each_of_their_buffers_needs) {
  std::vector<scene::WorldLight> lights;
  for (int i = 0; i < 100; ++i) lights.push_back(point_light({i < 33 ? 2.0 : 300.0, 0, -6}, 1.0));
  lights.push_back(spot_light({2, 0, -5}, 4.0, {0, 0, -1}, 0.4));
  const TwoTiles two(lights);
  // In view: 33 points and a spot, so two words for each of two tiles; of all 101 lights four. Four bins of two ranges.
  EXPECT_EQ(needs_of(*two.run("z-binning").structure()),
            (Needs{{"masks", 4, 4, 8, 2}, {"bins", 16, 4, 4, 1}, {"order", 4, 34, 101, 1}}));
  EXPECT_EQ(needs_of(*two.run("tile-ranges").structure()),
            (Needs{{"masks", 4, 4, 8, 2}, {"ranges", 8, 8, 8, 1}, {"order", 4, 34, 101, 1}}));
  // 13, 2 and 1 groups of eight boxes around the points, one around the spot.
  EXPECT_EQ(needs_of(*two.run("bvh").structure()),
            (Needs{{"boxes", 24, 8 * 17, 8 * 17, 8}, {"order", 4, 101, 101, 1}}));
}

TEST(ZBinning, lists_do_not_depend_on_the_order_of_lights_of_equal_depth) {
  // All at 6 m; by size they reach one slice, or three.
  std::vector<scene::WorldLight> lights;
  for (int i = 0; i < 12; ++i) lights.push_back(point_light({2, 0, -6}, i % 3 == 0 ? 5.0 : 0.5));
  for (const char* name : {"z-binning", "tile-ranges"}) {
    const std::size_t listed = at(TwoTiles(lights).run(name), 150, {0.5f, 0, -3}).size();
    EXPECT_EQ(listed, 4u) << name << ": the large ones alone";
    std::vector<scene::WorldLight> others(lights.rbegin(), lights.rend());
    EXPECT_EQ(at(TwoTiles(others).run(name), 150, {0.5f, 0, -3}).size(), listed) << name;
  }
}

TEST(TileRanges, a_tile_has_ranges_of_its_own) {
  // On the right a small light between two large ones, by depth; on the left a large one between these.
  const TwoTiles two({point_light({2, 0, -6}, 1.5), point_light({2, 0, -5.5}, 0.25), point_light({-3, 0, -5}, 1.5),
                      point_light({2, 0, -4.5}, 0.25), spot_light({3, 0, -6}, 0.5, {0, 0, -1}, 0.4)});
  const AssignerRun run = two.run("tile-ranges");
  using Lights = std::vector<std::uint32_t>;
  EXPECT_EQ(at(run, 150, {2, 0, -6}), (Lights{3, 1, 0, 4})) << "by depth, points before spots";
  EXPECT_EQ(at(run, 50, {-2, 0, -6}), Lights{2});
  EXPECT_EQ(at(run, 50, {-2, 0, -3.5f}), Lights{2});
  EXPECT_EQ(at(run, 150, {1, 0, -1.5f}), Lights());
  EXPECT_EQ(at(run, 150, {9, 0, -20}), Lights()) << "beyond the grid";
  const StructureUse use = run.structure()->use();
  EXPECT_EQ(use.index_entries, 2u) << "a word for each tile";
  EXPECT_EQ(use.header_bytes, 8u * 8u + 5u * 4u) << "two ranges of 16 bits for each cell, a number for each light";
}

TEST(TileRanges, list_no_more_than_ranges_of_whole_slices) {
  testing::Random random(3);
  std::vector<scene::WorldLight> lights;
  for (int i = 0; i < 300; ++i)
    lights.push_back(point_light({random.between(-9, 9), random.between(-4, 4), random.between(-15, -1)}, 1.0));
  const TwoTiles two(lights);
  const Lists wide = two.run("z-binning").structure()->expanded(),
              narrow = two.run("tile-ranges").structure()->expanded();
  EXPECT_LE(narrow.lights.size(), wide.lights.size());
  for (std::uint32_t cell = 0; cell < narrow.cell_count(); ++cell)
    for (const std::uint32_t light : narrow.of(cell))
      EXPECT_NE(std::ranges::find(wide.of(cell), light), wide.of(cell).end()) << cell << ", " << light;
}

TEST(TileRanges, ranks_are_wider_where_a_rig_needs_it) {
  std::vector<scene::WorldLight> lights(66000, point_light({2, 0, -6}, 0.5));
  const TwoTiles two(lights);
  const AssignerRun run = two.run("tile-ranges");
  EXPECT_EQ(run.structure()->use().header_bytes, 8u * 16u + 66000u * 4u);
  EXPECT_EQ(at(run, 150, {2, 0, -6}).size(), 66000u);
}

TEST(Bvh, a_sample_gets_the_lights_whose_boxes_hold_it_wherever_it_lies) {
  std::vector<scene::WorldLight> lights;
  for (int i = 0; i < 100; ++i) lights.push_back(point_light({3.0 * i, 0, -6}, 1.0));
  lights.push_back(spot_light({30, 0, -5}, 4.0, {0, 0, -1}, 0.4));
  const AssignerRun run = TwoTiles(lights).run("bvh");
  EXPECT_FALSE(run.has_cells());
  using Lights = std::vector<std::uint32_t>;
  EXPECT_EQ(at(run, 150, {3, 0, -6}), Lights{1});
  EXPECT_EQ(at(run, 150, {4.5f, 0, -6}), Lights());
  EXPECT_EQ(at(run, 150, {30, 0, -6}), (Lights{10, 100})) << "points before spots";
  EXPECT_EQ(at(run, 150, {297, 0, -6}), Lights{99}) << "beyond the picture";
  EXPECT_EQ(at(run, 150, {297, 0, 6}), Lights());
  // 13, 2 and 1 groups of eight boxes around the points, one around the spot.
  EXPECT_EQ(run.structure()->use().index_entries, 8u * (13u + 2u + 1u + 1u));
  EXPECT_EQ(run.structure()->use().index_bytes, 24u * run.structure()->use().index_entries);
  EXPECT_EQ(run.structure()->limit().index_entries, run.structure()->use().index_entries);
}

TEST(BallLanes, touch_what_each_ball_touches_alone_on_every_target) {
  testing::Random random(6);
  for (const std::uint32_t count : {0u, 1u, 7u, 16u, 33u, 200u}) {
    BallLanes lanes;
    std::vector<geom::Ball> balls;
    for (std::uint32_t i = 0; i < count; ++i) {
      const Vec3d at{random.between(-9.0, 9.0), random.between(-9.0, 9.0), random.between(-9.0, 9.0)};
      // Whole numbers, so that some touch by nothing; and one that is everywhere.
      balls.push_back({Vec3f(glm::round(at)), i == 5 ? std::numeric_limits<float>::infinity()
                                                     : static_cast<float>(std::round(random.between(0.0, 5.0)))});
      lanes.add(100 + i, balls.back());
    }
    const geom::Box box{{-2, -1, -3}, {2, 4, 1}};
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < count; ++i)
      if (geom::ball_touches_box(balls[i], box)) expected.push_back(100 + i);
    testing::on_each_target([&](const std::string& target) {
      std::vector<std::uint32_t> found(count + k_most_lanes);
      found.resize(lanes.touching(box, found.data()));
      EXPECT_EQ(found, expected) << target << ", " << count;
    });
  }
}

TEST(RadixSort, sorts_as_a_stable_sort_does_and_floats_by_their_bits) {
  RadixSort<std::uint32_t> sort;
  testing::Random random(5);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> expected;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    const auto value = static_cast<float>(std::round(random.between(-40.0, 40.0)) * (i % 3 == 0 ? 1e-30 : 1.0));
    sort.entries.push_back({ordered_bits(value), i});
    expected.emplace_back(ordered_bits(value), i);
  }
  std::stable_sort(expected.begin(), expected.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  sort.sort();
  for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_EQ(sort.entries[i].value, expected[i].second) << i;
  EXPECT_LT(ordered_bits(-2.0f), ordered_bits(-1.0f));
  EXPECT_LT(ordered_bits(-1.0f), ordered_bits(0.0f));
  EXPECT_LT(ordered_bits(0.5f), ordered_bits(std::numeric_limits<float>::infinity()));
}

}  // namespace
}  // namespace clusterbench::assign
