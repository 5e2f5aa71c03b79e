#include "measure/buffers.h"

#include <gtest/gtest.h>

#include "assign/contract/storage.h"

namespace clusterbench::measure {
namespace {

std::unique_ptr<assign::Storage> storage(const std::string& name,
                                         const std::map<std::string, assign::ParamValue>& params = {}) {
  const assign::StorageDescriptor& row = *assign::find_storage(name);
  return row.make(assign::Params(row.params, params));
}

constexpr std::uint32_t k_cells = 4, k_points = 2, k_spots = 1;

// Four cells and three lights: frames of 3, 5 and 1 pairs.
Buffers three_frames(assign::Storage& store, AllocationRule rule) {
  store.start(k_cells, {k_points, k_spots});
  BufferMeter meter(rule);
  const assign::Lists frames[] = {
      {{0, 1, 2, 3, 3}, {0, 1, 2}}, {{0, 0, 3, 5, 5}, {0, 1, 2, 0, 2}}, {{0, 0, 0, 0, 1}, {1}}};
  int frame = 20;
  std::size_t scratch = 100;
  for (const assign::Lists& lists : frames) {
    store.store(lists);
    meter.add_frame(frame++, store, &lists, scratch);
    scratch -= 10;
  }
  return meter.result();
}

TEST(Buffers, the_high_water_mark_is_the_largest_frame_and_names_it) {
  const Buffers b = three_frames(*storage("packed"), {.margin = 2.0, .warn_at = 0.9});
  EXPECT_EQ(b.index_entries.high_water, 5u);
  EXPECT_EQ(b.worst_frame, 21);
  EXPECT_EQ(b.worst_cell, 1u);
  EXPECT_EQ(b.index_bits, 8u);
  EXPECT_EQ(b.header_bytes, 8u * k_cells);
  EXPECT_EQ(b.bytes.high_water, 8u * k_cells + 5u);
  EXPECT_EQ(b.scratch_bytes, 100u);
}

TEST(Buffers, the_theoretical_maximum_is_every_light_in_every_cell) {
  const Buffers b = three_frames(*storage("packed"), {});
  EXPECT_EQ(b.index_entries.theoretical_max, 12u);
  EXPECT_EQ(b.bytes.theoretical_max, 8u * k_cells + 12u);
}

TEST(Buffers, the_recommendation_is_the_high_water_mark_with_its_margin_rounded_up) {
  const Buffers b = three_frames(*storage("packed"), {.margin = 1.5, .warn_at = 0.9});
  EXPECT_EQ(b.index_entries.recommended, 8u);
  EXPECT_EQ(b.bytes.recommended, 8u * k_cells + 8u);
  EXPECT_EQ(b.in_use_max, 5.0 / 8.0);
  EXPECT_EQ(b.in_use_mean, 3.0 / 8.0);
}

TEST(Buffers, the_recommendation_never_exceeds_the_theoretical_maximum) {
  const Buffers b = three_frames(*storage("packed"), {.margin = 10.0, .warn_at = 0.9});
  EXPECT_EQ(b.index_entries.recommended, 12u);
  EXPECT_EQ(b.bytes.recommended, 8u * k_cells + 12u);
}

TEST(Buffers, uploads_are_averaged_and_their_largest_kept) {
  const Buffers b = three_frames(*storage("packed"), {});
  EXPECT_EQ(b.upload_bytes_max, 8u * k_cells + 5u);
  EXPECT_EQ(b.upload_bytes_mean, 8.0 * k_cells + 3.0);
}

TEST(Buffers, bytes_are_kept_along_the_path_and_their_largest_is_the_high_water_mark) {
  const Buffers b = three_frames(*storage("packed"), {});
  const std::vector<std::uint64_t>& bytes = b.bytes_along_path.entries();
  ASSERT_EQ(bytes.size(), 3u);
  EXPECT_EQ(*std::max_element(bytes.begin(), bytes.end()), b.bytes.high_water);
  EXPECT_EQ(bytes[0] + bytes[1] + bytes[2], 3u * 8u * k_cells + 9u);
}

TEST(Buffers, overflow_is_counted_in_pairs_cells_and_frames_with_the_lights_lost) {
  const Buffers b = three_frames(*storage("fixed", {{"cap", 1.0}}), {});
  EXPECT_EQ(b.dropped_pairs, 3u);  // frame 21: two of cell 1, one of cell 2
  EXPECT_EQ(b.overflowing_cells, 2u);
  EXPECT_EQ(b.overflowing_frames, 1);
  EXPECT_EQ(b.dropped_lights, (std::set<std::uint32_t>{1, 2}));
}

TEST(Buffers, a_storage_with_room_per_cell_is_recommended_all_its_room) {
  const Buffers b = three_frames(*storage("fixed", {{"cap", 3.0}}), {.margin = 1.0, .warn_at = 0.9});
  EXPECT_EQ(b.index_entries.high_water, 5u);
  EXPECT_EQ(b.index_entries.recommended, 12u) << "an allocation of the entries in use would be overrun";
  EXPECT_EQ(b.bytes.recommended, b.bytes.high_water);
}

TEST(Buffers, without_frames_nothing_is_claimed) {
  EXPECT_EQ(BufferMeter({}).result().index_entries.recommended, 0u);
}

}  // namespace
}  // namespace clusterbench::measure
