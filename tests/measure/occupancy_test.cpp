#include "measure/lists/occupancy.h"

#include <gtest/gtest.h>

#include <numeric>

namespace clusterbench::measure {
namespace {

TEST(Spread, percentiles_are_values_that_occur) {
  std::vector<double> values(200);
  std::iota(values.rbegin(), values.rend(), 1.0);  // 200 .. 1
  const Spread spread = spread_of(values);
  EXPECT_EQ(spread.mean, 100.5);
  EXPECT_EQ(spread.p50, 100.0);
  EXPECT_EQ(spread.p95, 190.0);
  EXPECT_EQ(spread.p99, 198.0);
  EXPECT_EQ(spread.max, 200.0);
}

TEST(Spread, of_few_values_the_high_percentiles_are_the_largest) {
  const Spread spread = spread_of({3.0, 1.0, 2.0});
  EXPECT_EQ(spread.p50, 2.0);
  EXPECT_EQ(spread.p95, 3.0);
  EXPECT_EQ(spread.p99, 3.0);
}

TEST(Spread, of_nothing_is_zero) {
  EXPECT_EQ(spread_of({}).max, 0.0);
  EXPECT_EQ(OccupancyMeter(4).result().lights_per_cell.max, 0.0);
}

// Four cells with 0, 2, 1 and 0 lights, then with 3, 0, 0 and 1.
Occupancy two_frames(std::uint32_t real_cells) {
  OccupancyMeter meter(real_cells);
  meter.add_frame(10, {{0, 0, 2, 3, 3}, {0, 1, 2}});
  meter.add_frame(11, {{0, 3, 3, 3, 4}, {0, 1, 2, 0}});
  return meter.result();
}

TEST(Occupancy, cells_are_counted_by_their_lights_over_all_frames) {
  const Occupancy o = two_frames(4);
  EXPECT_EQ(o.histogram, (std::vector<std::uint64_t>{4, 2, 1, 1}));
  EXPECT_EQ(o.lights_per_cell.mean, 7.0 / 8.0);
  EXPECT_EQ(o.lights_per_cell.p50, 0.0);
  EXPECT_EQ(o.lights_per_cell.p95, 3.0);
  EXPECT_EQ(o.lights_per_cell.max, 3.0);
}

TEST(Histogram, of_long_lists_joins_lengths_and_keeps_all_cells) {
  const Histogram exact = short_histogram({4, 2, 1, 1});
  EXPECT_EQ(exact.lights_per_entry, 1u);
  EXPECT_EQ(exact.cells, (std::vector<std::uint64_t>{4, 2, 1, 1}));
  EXPECT_EQ(short_histogram(std::vector<std::uint64_t>(256, 1)).lights_per_entry, 1u);
  std::vector<std::uint64_t> counts(1025);
  std::iota(counts.begin(), counts.end(), 0u);
  const Histogram joined = short_histogram(counts);
  EXPECT_EQ(joined.lights_per_entry, 8u);
  ASSERT_EQ(joined.cells.size(), 129u);
  EXPECT_EQ(joined.cells[1], 8u + 9 + 10 + 11 + 12 + 13 + 14 + 15);
  EXPECT_EQ(joined.cells.back(), 1024u);
  EXPECT_EQ(std::accumulate(joined.cells.begin(), joined.cells.end(), 0u), 1024u * 1025u / 2u);
}

TEST(Occupancy, pairs_and_occupied_share_are_per_frame) {
  const Occupancy o = two_frames(4);
  EXPECT_EQ(o.pairs.mean, 3.5);
  EXPECT_EQ(o.pairs.p50, 3.0);
  EXPECT_EQ(o.pairs.max, 4.0);
  EXPECT_EQ(o.occupied_fraction.mean, 0.5);
}

TEST(Occupancy, the_longest_list_is_named_with_its_frame_and_cell) {
  const Occupancy o = two_frames(4);
  EXPECT_EQ(o.worst_frame, 11);
  EXPECT_EQ(o.worst_cell, 0u);
  EXPECT_EQ(o.worst_count, 3u);
}

TEST(Occupancy, pairs_and_longest_lists_are_kept_along_the_path) {
  const Occupancy o = two_frames(4);
  EXPECT_EQ(o.pairs_along_path.entries(), (std::vector<std::uint64_t>{3, 4}));
  EXPECT_EQ(o.longest_along_path.entries(), (std::vector<std::uint64_t>{2, 3}));
}

TEST(Occupancy, holes_are_no_cells) {
  const Occupancy o = two_frames(3);
  EXPECT_EQ(o.histogram, (std::vector<std::uint64_t>{2, 2, 1, 1}));
  EXPECT_EQ(o.occupied_fraction.mean, 2.0 / 3.0);
  EXPECT_EQ(o.lights_per_cell.p50, 1.0);
}

// 2 x 1 tiles, slices from 1 to 2, 4 and 8 m.
grid::Grid three_slices(float far) {
  grid::ScreenGrid out;
  out.tiles.count = {2, 1};
  out.slices.boundaries = {1.0f, 2.0f, 4.0f, far};
  return {out};
}

TEST(LongestBySlice, is_of_the_fullest_cell_of_each_slice_over_all_frames) {
  LongestBySlice meter;
  meter.add_frame(three_slices(8.0f), {{0, 1, 3, 3, 3, 3, 4}, {0, 0, 1, 2}});
  meter.add_frame(three_slices(8.0f), {{0, 3, 3, 3, 3, 3, 3}, {0, 1, 2}});
  EXPECT_EQ(meter.result(), (std::vector<std::uint32_t>{3, 0, 1}));
}

TEST(LongestBySlice, is_of_no_depth_where_slices_move) {
  LongestBySlice meter;
  meter.add_frame(three_slices(8.0f), {{0, 1, 3, 3, 3, 3, 4}, {0, 0, 1, 2}});
  meter.add_frame(three_slices(9.0f), {{0, 1, 3, 3, 3, 3, 4}, {0, 0, 1, 2}});
  EXPECT_TRUE(meter.result().empty());
}

TEST(LongestBySlice, is_not_of_world_grids) {
  LongestBySlice meter;
  meter.add_frame({grid::WorldGrid{}}, {{0, 1}, {0}});
  EXPECT_TRUE(meter.result().empty());
}

}  // namespace
}  // namespace clusterbench::measure
