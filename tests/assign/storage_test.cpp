#include "assign/contract/storage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "assign/stored_lists.h"
#include "core/error.h"

namespace clusterbench::assign {
namespace {

TEST(Packed, lists_read_back_as_they_were_stored) {
  for (const std::uint32_t lights : {1u, 200u, 256u, 257u, 3000u, 70000u}) {
    const Lists lists = random_lists(40, lights, 0.02, lights);
    const auto packed = storage("packed");
    packed->start(40, {lights / 2, lights - lights / 2});
    packed->store(lists);
    EXPECT_EQ(packed->expanded(), lists) << lights << " lights";
    EXPECT_EQ(packed->use().dropped_pairs, 0u);
  }
}

TEST(Packed, gives_all_lights_of_the_frame_from_the_first_list_on_that_has_no_room) {
  struct Row {
    std::uint32_t cells, lights;
    double share;
    const char* headers;
  };
  constexpr Row k_rows[] = {{40, 200, 0.05, "dense"},
                            {40, 200, 0.002, "sparse"},
                            {40, 3000, 0.02, "sparse"},
                            {6, 70000, 0.9, "dense"},
                            {6, 70000, 0.9, "sparse"}};
  for (const Row& row : k_rows) {
    const Lists lists = random_lists(row.cells, row.lights, row.share, 7);
    Ids all = lists.lights;
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    const std::uint32_t kept = row.cells / 3;  // lists that have room to the last entry
    const std::uint32_t room = std::max(row.lights, static_cast<std::uint32_t>(all.size()) + lists.begin[kept]);
    const auto packed =
        storage("packed", {{"max_entries", static_cast<double>(room)}, {"headers", std::string(row.headers)}});
    packed->start(row.cells, {row.lights, 0});
    for (int again = 0; again < 2; ++again) packed->store(lists);
    std::uint64_t used = all.size(), fallback_cells = 0;
    bool is_full = false;
    for (std::uint32_t cell = 0; cell < row.cells; ++cell) {
      const Ids own(lists.of(cell).begin(), lists.of(cell).end());
      is_full = is_full || used + own.size() > room;
      if (!is_full) used += own.size();
      if (is_full && !own.empty()) ++fallback_cells;
      Ids read;
      packed->read_cell(cell, read);
      EXPECT_EQ(read, is_full && !own.empty() ? all : own) << cell << ", " << row.headers;
    }
    EXPECT_EQ(packed->use().index_entries, used);
    EXPECT_EQ(packed->use().fallback_cells, fallback_cells);
    EXPECT_EQ(packed->use().dropped_pairs, 0u);
    packed->store(lists_from(std::vector<Ids>(row.cells)));
    EXPECT_EQ(packed->use().index_entries, 0u);
    EXPECT_EQ(packed->use().fallback_cells, 0u);
  }
}

// Whatever there was room for: a buffer is sized so that every list fits.
TEST(Packed, needs_a_buffer_for_all_lists_also_where_some_had_no_room) {
  for (const char* equal : {"repeated", "shared"}) {
    Lists lists = random_lists(40, 200, 0.05, 7);
    std::vector<Ids> doubled;
    for (std::uint32_t cell = 0; cell < 40; ++cell)
      doubled.insert(doubled.end(), 2, Ids(lists.of(cell).begin(), lists.of(cell).end()));
    lists = lists_from(doubled);
    const auto roomy = storage("packed", {{"equal_lists", std::string(equal)}}),
               tight = storage("packed", {{"equal_lists", std::string(equal)}, {"max_entries", 250.0}});
    for (const auto* each : {&roomy, &tight}) {
      (*each)->start(80, {200, 0});
      (*each)->store(lists);
    }
    ASSERT_GT(tight->use().fallback_cells, 0u);
    const Ids all(lists.lights.begin(), lists.lights.end());
    const std::uint64_t listed = std::set<std::uint32_t>(all.begin(), all.end()).size();
    EXPECT_EQ(tight->buffers()[0].elements, roomy->buffers()[0].elements + listed) << "after the list of all lights";
    EXPECT_EQ(tight->buffers()[0].most, roomy->buffers()[0].most + 200);
  }
}

TEST(Packed, refuses_room_for_fewer_entries_than_lights) {
  const auto packed = storage("packed", {{"max_entries", 99.0}});
  EXPECT_NO_THROW(packed->start(10, {50, 49}));
  EXPECT_THROW(packed->start(10, {50, 50}), Error);
}

TEST(Packed, takes_the_narrowest_index_that_holds_the_last_light) {
  const auto bits = [](std::uint32_t points, std::uint32_t spots) {
    const auto packed = storage("packed");
    packed->start(1, {points, spots});
    return packed->index_bits();
  };
  EXPECT_EQ(bits(0, 0), 8u);
  EXPECT_EQ(bits(200, 56), 8u);
  EXPECT_EQ(bits(200, 57), 16u);
  EXPECT_EQ(bits(65536, 0), 16u);
  EXPECT_EQ(bits(65536, 1), 32u);
}

TEST(Packed, counts_8_bytes_per_cell_and_the_index_width_per_pair) {
  const Lists lists = lists_from({{0, 7}, {}, {1, 2, 6}});
  for (const char* bits : {"8", "16", "32"}) {
    const auto packed = storage("packed", {{"index_bits", std::string(bits)}});
    packed->start(3, {5, 3});
    packed->store(lists);
    const StructureUse use = packed->use();
    const std::uint64_t width = std::stoul(bits) / 8;
    EXPECT_EQ(use.index_entries, 5u);
    EXPECT_EQ(use.index_bytes, 5u * width);
    EXPECT_EQ(use.header_bytes, 24u);
    EXPECT_EQ(use.upload_bytes, 24u + 5u * width);
    EXPECT_EQ(packed->limit().index_entries, 24u);
    EXPECT_EQ(packed->limit().bytes, 24u + 24u * width);
    EXPECT_EQ(packed->expanded(), lists);
  }
}

// Bevy's has 32 bytes.
TEST(Packed, a_header_can_be_larger_than_its_counts_and_is_never_smaller) {
  const Lists lists = lists_from({{0, 7}, {}, {1, 2, 6}});
  constexpr std::pair<double, std::uint64_t> k_sizes[] = {{0, 8}, {4, 12}, {12, 12}, {30, 32}, {32, 32}, {256, 256}};
  for (const auto& [asked, bytes] : k_sizes) {
    const auto packed = storage("packed", {{"index_bits", std::string("32")}, {"header_size", asked}});
    packed->start(3, {5, 3});
    packed->store(lists);
    EXPECT_EQ(packed->use().header_bytes, 3 * bytes) << asked;
    EXPECT_EQ(packed->use().upload_bytes, 3 * bytes + 20) << asked;
    EXPECT_EQ(packed->limit().bytes, 3 * bytes + 24 * 4) << asked;
    EXPECT_EQ(packed->buffers()[1].element_bytes, bytes) << asked;
    EXPECT_EQ(packed->reads_of_cell(0).bytes, bytes + 8) << asked;
    EXPECT_EQ(packed->expanded(), lists) << asked;
  }
  const auto with_boxes = storage("packed", {{"header_size", 4.0}});
  with_boxes->start(3, {4, 2, 2});
  with_boxes->store(lists);
  EXPECT_EQ(with_boxes->use().header_bytes, 48u);
  EXPECT_EQ(with_boxes->expanded(), lists);
}

TEST(Packed, a_forced_width_that_cannot_hold_the_rig_is_refused) {
  const auto packed = storage("packed", {{"index_bits", std::string("8")}});
  EXPECT_NO_THROW(packed->start(1, {256, 0}));
  try {
    packed->start(1, {256, 1});
    FAIL() << "257 lights were taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "index_bits");
    EXPECT_EQ(error.message(), "is 8, but 257 lights need 16 bits");
  }
}

TEST(Packed, headers_widen_once_where_a_cull_leaves_more_lights_of_one_type_than_they_count) {
  const auto packed = storage("packed");
  packed->start(1, {40000, 40000});
  packed->store(lists_from({{1, 50000}}));
  EXPECT_EQ(packed->use().header_bytes, 8u);
  for (const std::uint32_t points : {70000u, 40000u}) {
    packed->set_types({points, 80000 - points});
    packed->store(lists_from({{1, 50000}}));
    EXPECT_EQ(packed->use().header_bytes, 12u);
    EXPECT_EQ(packed->expanded(), lists_from({{1, 50000}}));
  }
}

TEST(Packed, the_limit_has_wide_headers_only_where_a_count_can_need_them) {
  const auto limit = [](std::uint32_t points, std::uint32_t spots) {
    const auto packed = storage("packed");
    packed->start(2, {points, spots});
    return packed->limit().bytes;
  };
  EXPECT_EQ(limit(40000, 40000), 2u * 80000u * 4u + 16u);
  EXPECT_EQ(limit(65536, 0), 2u * 65536u * 2u + 24u);
}

TEST(Packed, boxes_cost_one_word_more_per_header_and_read_back) {
  const Lists lists = lists_from({{0, 5, 6, 8, 9}, {}, {9}, {1, 2, 7}});
  for (const char* headers : {"dense", "sparse"}) {
    const auto packed = storage("packed", {{"headers", std::string(headers)}});
    packed->start(4, {5, 3, 2});
    packed->store(lists);
    const bool is_sparse = std::string(headers) == "sparse";
    EXPECT_EQ(packed->use().header_bytes, is_sparse ? 3u * 12u + 8u : 4u * 12u);
    EXPECT_EQ(packed->expanded(), lists) << headers;
    EXPECT_EQ(packed->buffers()[1].element_bytes, 12u);
  }
  // Many boxes do not widen the counts of points and spots; many spots do.
  const auto packed = storage("packed");
  packed->start(1, {1, 1, 70000});
  EXPECT_EQ(packed->buffers()[1].element_bytes, 12u);
  packed->start(1, {1, 70000, 1});
  EXPECT_EQ(packed->buffers()[1].element_bytes, 16u);
}

TEST(Packed, sparse_headers_read_back_as_they_were_stored) {
  for (const std::uint32_t cells : {1u, 31u, 32u, 33u, 200u})
    for (const double share : {0.0, 0.01, 0.3, 1.0}) {
      const auto packed = storage("packed", {{"headers", std::string("sparse")}});
      packed->start(cells, {20, 20});
      for (const std::uint64_t seed : {1u, 2u}) {
        const Lists lists = random_lists(cells, 40, share, seed);
        packed->store(lists);
        EXPECT_EQ(packed->expanded(), lists) << cells << " cells, " << share;
      }
    }
}

TEST(Packed, with_sparse_headers_a_cell_without_lights_costs_nothing_but_its_bits_in_a_block) {
  const auto header_bytes = [](const char* headers, std::uint32_t touched) {
    std::vector<Ids> cells(64);
    for (std::uint32_t cell = 0; cell < touched; ++cell) cells[3 * cell] = {1, 2};
    const auto packed = storage("packed", {{"headers", std::string(headers)}});
    packed->start(64, {4, 0});
    packed->store(lists_from(cells));
    EXPECT_EQ(packed->use().upload_bytes, packed->use().header_bytes + 2 * touched);
    return packed->use().header_bytes;
  };
  EXPECT_EQ(header_bytes("dense", 0), 64u * 8);
  EXPECT_EQ(header_bytes("dense", 5), 64u * 8);
  EXPECT_EQ(header_bytes("sparse", 0), 2u * 8);
  EXPECT_EQ(header_bytes("sparse", 5), 2u * 8 + 5 * 8);
  const auto sparse = storage("packed", {{"headers", std::string("sparse")}});
  sparse->start(64, {4, 0});
  EXPECT_EQ(sparse->limit().bytes, 64u * 4 + 64 * 8 + 2 * 8);
}

TEST(Fixed, lists_within_the_cap_read_back_as_they_were_stored) {
  for (const std::uint32_t lights : {90u, 300u, 70000u}) {
    const Lists lists = random_lists(30, lights, 10.0 / lights, lights);
    const auto fixed = storage("fixed");
    fixed->start(30, {lights, 0});
    fixed->store(lists);
    EXPECT_EQ(fixed->expanded(), lists);
    EXPECT_EQ(fixed->use().dropped_pairs, 0u);
    EXPECT_EQ(fixed->use().overflowing_cells, 0u);
    EXPECT_TRUE(fixed->use().dropped_lights.empty());
  }
}

TEST(Fixed, drops_the_highest_light_indices_and_counts_what_it_dropped) {
  const auto fixed = storage("fixed", {{"cap", 2.0}});
  fixed->start(4, {6, 4});
  fixed->store(lists_from({{0, 1}, {3, 5, 7, 9}, {}, {1, 2, 7}}));
  EXPECT_EQ(fixed->expanded(), lists_from({{0, 1}, {3, 5}, {}, {1, 2}}));
  const StructureUse use = fixed->use();
  EXPECT_EQ(use.dropped_pairs, 3u);
  EXPECT_EQ(use.overflowing_cells, 2u);
  EXPECT_EQ(use.dropped_lights, (Ids{7, 9}));
  EXPECT_EQ(use.index_entries, 6u);
}

TEST(Fixed, without_counts_ends_a_list_that_is_not_full_by_an_index_that_is_no_lights) {
  const auto fixed = storage("fixed", {{"cap", 2.0}, {"counts", std::string("none")}});
  fixed->start(4, {6, 4});
  EXPECT_EQ(fixed->expanded(), lists_from({{}, {}, {}, {}}));
  fixed->store(lists_from({{0, 1}, {3, 5, 7, 9}, {}, {9}}));
  EXPECT_EQ(fixed->expanded(), lists_from({{0, 1}, {3, 5}, {}, {9}}));
  EXPECT_EQ(fixed->use().dropped_pairs, 2u);
  EXPECT_EQ(fixed->use().header_bytes, 0u);
  EXPECT_EQ(fixed->use().upload_bytes, 8u) << "as RGBA8 texels have it: a byte per index, and nothing else";
  EXPECT_EQ(fixed->limit().bytes, 8u);
  fixed->store(lists_from({{}, {1}, {2, 3}, {}}));
  EXPECT_EQ(fixed->expanded(), lists_from({{}, {1}, {2, 3}, {}})) << "of the frame before nothing is left";
}

TEST(Fixed, without_counts_needs_one_index_more_than_there_are_lights) {
  for (const std::uint32_t lights : {255u, 256u}) {
    const auto fixed = storage("fixed", {{"cap", 3.0}, {"counts", std::string("none")}});
    fixed->start(1, {lights, 0});
    EXPECT_EQ(fixed->index_bits(), lights == 255 ? 8u : 16u);
    fixed->store(lists_from({{0, lights - 1}}));
    EXPECT_EQ(fixed->expanded(), lists_from({{0, lights - 1}}));
  }
}

TEST(Fixed, takes_the_same_bytes_whatever_is_stored) {
  const auto fixed = storage("fixed", {{"cap", 10.0}});
  fixed->start(4, {300, 0});
  for (const double share : {0.0, 0.5}) {
    fixed->store(random_lists(4, 300, share, 3));
    const StructureUse use = fixed->use();
    EXPECT_EQ(use.index_bytes, 4u * 10u * 2u);
    EXPECT_EQ(use.header_bytes, 16u);
    EXPECT_EQ(use.upload_bytes, 96u);
    EXPECT_EQ(fixed->limit().bytes, 96u);
    EXPECT_EQ(fixed->limit().index_entries, 40u);
  }
}

TEST(Fixed, forgets_the_overflow_of_the_frame_before) {
  const auto fixed = storage("fixed", {{"cap", 1.0}});
  fixed->start(2, {3, 0});
  fixed->store(lists_from({{0, 1, 2}, {2}}));
  EXPECT_EQ(fixed->use().dropped_pairs, 2u);
  fixed->store(lists_from({{1}, {}}));
  EXPECT_EQ(fixed->use().dropped_pairs, 0u);
  EXPECT_TRUE(fixed->use().dropped_lights.empty());
  EXPECT_EQ(fixed->expanded(), lists_from({{1}, {}}));
}

TEST(Fixed, the_cap_is_100_and_whole_and_at_most_65535) {
  const StorageDescriptor* row = find_storage("fixed");
  EXPECT_EQ(Params(row->params).number("cap"), 100.0);
  for (const double cap : {0.0, 65536.0, 1.5}) EXPECT_THROW(Params(row->params, {{"cap", cap}}), Error) << cap;
}

TEST(Bitfield, lists_read_back_as_they_were_stored) {
  for (const std::uint32_t lights : {1u, 31u, 32u, 33u, 200u, 3000u})
    for (const double share : {0.0, 0.02, 0.7, 1.0}) {
      const Lists lists = random_lists(40, lights, share, lights);
      const auto bitfield = storage("bitfield");
      bitfield->start(40, {lights / 2, lights - lights / 2});
      bitfield->store(lists);
      EXPECT_EQ(bitfield->expanded(), lists) << lights << " lights, " << share;
      EXPECT_EQ(bitfield->use().dropped_pairs, 0u);
    }
}

TEST(Bitfield, takes_a_word_for_every_32_lights_in_each_cell_whatever_is_stored) {
  const auto words = [](std::uint32_t lights, double share) {
    const auto bitfield = storage("bitfield");
    bitfield->start(5, {lights, 0});
    bitfield->store(random_lists(5, lights, share, 1));
    const StructureUse use = bitfield->use();
    EXPECT_EQ(use.index_entries * 4, use.index_bytes);
    EXPECT_EQ(use.header_bytes, 0u);
    EXPECT_EQ(use.upload_bytes, use.index_bytes);
    EXPECT_EQ(bitfield->limit().index_entries, use.index_entries);
    EXPECT_EQ(bitfield->limit().bytes, use.index_bytes);
    EXPECT_EQ(bitfield->index_bits(), 32u);
    return use.index_entries / 5;
  };
  EXPECT_EQ(words(0, 0.0), 0u);
  for (const double share : {0.0, 0.5}) {
    EXPECT_EQ(words(1, share), 1u);
    EXPECT_EQ(words(32, share), 1u);
    EXPECT_EQ(words(33, share), 2u);
  }
}

TEST(Bitfield, forgets_the_bits_of_the_frame_before) {
  const auto bitfield = storage("bitfield");
  bitfield->start(2, {40, 0});
  bitfield->store(lists_from({{0, 1, 39}, {2}}));
  bitfield->store(lists_from({{}, {1, 2}}));
  EXPECT_EQ(bitfield->expanded(), lists_from({{}, {1, 2}}));
}

TEST(Bitfield, one_that_no_buffer_can_hold_is_refused) {
  try {
    storage("bitfield")->start(100'000, {500'000, 0});
    FAIL() << "6 GB were taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "limits.memory_mib");
    EXPECT_EQ(error.message(),
              "1562500000 words of bits would take 5960 MiB, and 4096 MiB are allowed; raise the limit, or use fewer "
              "lights or cells");
  }
}

TEST(Packed, lists_that_are_shared_read_back_as_they_were_stored) {
  const auto packed = storage("packed", {{"equal_lists", std::string("shared")}});
  // Rows of equal lists, others of the same length, and empty ones.
  const Lists lists = lists_from({{0, 3}, {0, 3}, {0, 3}, {1, 3}, {}, {1, 3}, {}, {2}, {2}, {0, 1, 2, 3}});
  packed->start(10, {3, 1});
  packed->store(lists);
  EXPECT_EQ(packed->expanded(), lists);
  EXPECT_EQ(packed->use().index_entries, 2u + 2u + 2u + 1u + 4u) << "[1, 3] is no neighbour of the other [1, 3]";
  EXPECT_EQ(packed->limit().index_entries, 40u);
  for (const double share : {0.02, 0.5, 1.0}) {
    const Lists random = random_lists(200, 20, share, 3);
    packed->start(200, {10, 10});
    packed->store(random);
    EXPECT_EQ(packed->expanded(), random);
    EXPECT_LE(packed->use().index_entries, random.lights.size());
  }
  EXPECT_EQ(packed->use().index_entries, 20u) << "all cells have all lights";
}

TEST(Runs, are_of_consecutive_lights_of_one_type) {
  const auto runs = storage("runs");
  const Lists lists = lists_from({{0, 1, 2, 5, 6, 9}, {}, {3, 4}, {9}});
  runs->start(4, {5, 5});
  runs->store(lists);
  EXPECT_EQ(runs->expanded(), lists);
  EXPECT_EQ(runs->use().index_entries, 3u + 0u + 1u + 1u);
  EXPECT_EQ(runs->use().index_bytes, 2u * 5u);
  EXPECT_EQ(runs->use().header_bytes, 4u * 8u);
  EXPECT_EQ(runs->limit().index_entries, 4u * (3u + 3u)) << "every second light, of each type";
  runs->store(lists_from({{3, 4, 5, 6}, {}, {}, {}}));
  EXPECT_EQ(runs->use().index_entries, 2u) << "points and spots apart";
  runs->start(1, {300, 0});
  EXPECT_EQ(runs->index_bits(), 32u);
  runs->start(1, {200000, 0});
  EXPECT_EQ(runs->use().header_bytes, 12u) << "100,000 runs of one type";
}

TEST(Linked, lists_read_back_as_they_were_stored) {
  for (const double share : {0.0, 0.02, 0.7}) {
    const Lists lists = random_lists(40, 300, share, 3);
    const auto linked = storage("linked", {{"nodes_per_cell", 300.0}});
    linked->start(40, {200, 100});
    linked->store(lists);
    EXPECT_EQ(linked->expanded(), lists) << share;
    EXPECT_EQ(linked->use().dropped_pairs, 0u);
    EXPECT_TRUE(linked->use().dropped_lights.empty());
  }
}

TEST(Linked, counts_4_bytes_per_cell_and_8_per_pair) {
  const auto linked = storage("linked");
  linked->start(4, {5, 3});
  linked->store(lists_from({{0, 7}, {}, {1, 2, 6}, {}}));
  const StructureUse use = linked->use();
  EXPECT_EQ(use.index_entries, 5u);
  EXPECT_EQ(use.index_bytes, 40u);
  EXPECT_EQ(use.header_bytes, 16u);
  EXPECT_EQ(use.upload_bytes, 56u);
  EXPECT_EQ(linked->index_bits(), 64u);
  EXPECT_EQ(linked->limit().index_entries, 32u) << "every light in every cell";
  EXPECT_EQ(linked->limit().bytes, 32u * 8 + 16);
}

TEST(Linked, a_full_pool_drops_what_it_would_if_lights_came_one_after_the_other) {
  const auto linked = storage("linked", {{"nodes_per_cell", 1.25}});
  linked->start(4, {6, 4});
  linked->store(lists_from({{0, 5, 9}, {5}, {0, 5}, {5, 7}}));  // 8 pairs, 5 nodes: 0 twice, 5 three times
  EXPECT_EQ(linked->expanded(), lists_from({{0, 5}, {5}, {0, 5}, {}}));
  const StructureUse use = linked->use();
  EXPECT_EQ(use.index_entries, 5u);
  EXPECT_EQ(use.dropped_pairs, 3u);
  EXPECT_EQ(use.overflowing_cells, 2u);
  EXPECT_EQ(use.dropped_lights, (Ids{5, 7, 9}));
  EXPECT_EQ(linked->limit().index_entries, 5u);
}

TEST(Linked, forgets_the_overflow_of_the_frame_before) {
  const auto linked = storage("linked", {{"nodes_per_cell", 1.0}});
  linked->start(2, {3, 0});
  linked->store(lists_from({{0, 1, 2}, {2}}));
  EXPECT_EQ(linked->use().dropped_pairs, 2u);
  linked->store(lists_from({{1}, {}}));
  EXPECT_EQ(linked->use().dropped_pairs, 0u);
  EXPECT_TRUE(linked->use().dropped_lights.empty());
  EXPECT_EQ(linked->expanded(), lists_from({{1}, {}}));
}

}  // namespace
}  // namespace clusterbench::assign
