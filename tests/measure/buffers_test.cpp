#include "measure/lists/buffers.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "assign/contract/storage.h"
#include "core/random.h"

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

// What frames of random lists need, counted list by list; and what the meter says of it.
struct CountedFrames {
  std::uint64_t pairs = 0, longest = 0, with_lights = 0;  // of the worst frame of each
  Buffers buffers;
};

CountedFrames random_frames(assign::Storage& store, std::uint32_t cells, view::LightRanges lights) {
  SplitMix64 random(11);
  store.start(cells, lights);
  BufferMeter meter({});
  CountedFrames out;
  for (int frame = 0; frame < 20; ++frame) {
    assign::Lists lists{{0}, {}};
    std::uint64_t longest = 0, with_lights = 0;
    const double share = random.unit();
    for (std::uint32_t cell = 0; cell < cells; ++cell) {
      for (std::uint32_t light = 0; light < lights.size(); ++light)
        if (random.unit() < share * share) lists.lights.push_back(light);
      const std::uint64_t length = lists.lights.size() - lists.begin.back();
      longest = std::max(longest, length);
      with_lights += length > 0 ? 1 : 0;
      lists.begin.push_back(static_cast<std::uint32_t>(lists.lights.size()));
    }
    store.store(lists);
    meter.add_frame(frame, store, &lists, 0);
    out.pairs = std::max<std::uint64_t>(out.pairs, lists.lights.size());
    out.longest = std::max(out.longest, longest);
    out.with_lights = std::max(out.with_lights, with_lights);
  }
  out.buffers = meter.result();
  return out;
}

struct Expected {
  std::string name;
  std::uint64_t bytes, high_water, most;
};

void expect_buffers(const Buffers& found, const std::vector<Expected>& expected) {
  ASSERT_EQ(found.each.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const BufferHighWater& buffer = found.each[i];
    EXPECT_EQ(buffer.name, expected[i].name);
    EXPECT_EQ(buffer.element_bytes, expected[i].bytes) << buffer.name;
    EXPECT_EQ(buffer.high_water, expected[i].high_water) << buffer.name;
    EXPECT_EQ(buffer.theoretical_max, expected[i].most) << buffer.name;
    const std::vector<std::uint64_t>& along = buffer.along_path.entries();
    ASSERT_EQ(along.size(), 20u);
    EXPECT_EQ(along[static_cast<std::size_t>(buffer.worst_frame)], buffer.high_water) << buffer.name;
    EXPECT_EQ(*std::max_element(along.begin(), along.end()), buffer.high_water) << buffer.name;
  }
}

TEST(Buffers, each_is_what_a_count_of_the_lists_says) {
  constexpr std::uint32_t cells = 70, lights = 300;
  const view::LightRanges ranges(200, 100);
  const auto packed = storage("packed"), sparse = storage("packed", {{"headers", std::string("sparse")}}),
             fixed = storage("fixed", {{"cap", 5.0}}), bits = storage("bitfield"),
             linked = storage("linked", {{"nodes_per_cell", 0.5}});
  CountedFrames frames = random_frames(*packed, cells, ranges);
  expect_buffers(frames.buffers, {{"indices", 2, frames.pairs, cells * lights}, {"headers", 8, cells, cells}});
  frames = random_frames(*sparse, cells, ranges);
  expect_buffers(frames.buffers, {{"indices", 2, frames.pairs, cells * lights},
                                  {"headers", 8, frames.with_lights, cells},
                                  {"header_blocks", 8, 3, 3}});
  frames = random_frames(*fixed, cells, ranges);
  EXPECT_GT(frames.buffers.dropped_pairs, 0u);
  EXPECT_EQ(frames.buffers.each[0].step, cells);
  expect_buffers(frames.buffers, {{"indices", 2, frames.longest * cells, cells * lights}, {"counts", 4, cells, cells}});
  frames = random_frames(*bits, cells, ranges);
  expect_buffers(frames.buffers, {{"words", 4, cells * 10, cells * 10}});
  frames = random_frames(*linked, cells, ranges);
  EXPECT_GT(frames.buffers.dropped_pairs, 0u) << "and it is what would have been needed that counts";
  expect_buffers(frames.buffers, {{"nodes", 8, frames.pairs, cells * lights}, {"heads", 4, cells, cells}});
}

TEST(Buffers, each_together_take_what_the_structure_says_that_it_takes) {
  for (const std::string& name : assign::storage_names()) {
    const auto store = storage(name);
    const CountedFrames frames = random_frames(*store, 16, {20, 20});
    if (name == "linked") continue;  // its pool ends before that
    EXPECT_EQ(frames.buffers.dropped_pairs, 0u) << name;
    std::uint64_t high_water = 0, most = 0;
    for (const BufferHighWater& buffer : frames.buffers.each) {
      high_water += buffer.high_water * buffer.element_bytes;
      most += buffer.theoretical_max * buffer.element_bytes;
    }
    if (name == "fixed") continue;  // its parameter reserves more
    EXPECT_EQ(high_water, frames.buffers.bytes.high_water) << name;
    EXPECT_EQ(most, frames.buffers.bytes.theoretical_max) << name;
  }
}

TEST(Buffers, of_no_lights_only_what_cells_have_is_needed) {
  for (const std::string& name : assign::storage_names()) {
    const auto store = storage(name);
    store->start(3, view::LightRanges(0, 0));
    BufferMeter meter({});
    const assign::Lists none{{0, 0, 0, 0}, {}};
    store->store(none);
    meter.add_frame(0, *store, &none, 0);
    for (const BufferHighWater& buffer : meter.result().each)
      EXPECT_EQ(buffer.high_water, buffer.theoretical_max == 0 ? 0u : 3u) << name << " " << buffer.name;
  }
}

TEST(Buffers, without_frames_nothing_is_claimed) {
  EXPECT_EQ(BufferMeter({}).result().index_entries.recommended, 0u);
}

}  // namespace
}  // namespace clusterbench::measure
