#include "layout/decode.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/memory.h"
#include "layout/encoders.h"

namespace clusterbench::layout {
namespace {

using namespace testing;

constexpr Vec3i k_cells{5, 3, 4};
constexpr std::uint32_t k_lights = 70;

std::string order_name(const CellOrder& order) {
  return order.axes + (order.is_from_bottom ? " from the bottom" : "") + (order.is_from_far ? " from the far end" : "");
}

TEST(CellOrder, the_cell_of_a_number_is_the_one_that_has_it) {
  for (const CellOrder& order : all_orders())
    for (int z = 0; z < k_cells.z; ++z)
      for (int y = 0; y < k_cells.y; ++y)
        for (int x = 0; x < k_cells.x; ++x) {
          const Vec3i at{x, y, z};
          EXPECT_EQ(order.cell_at(order.cell(at, k_cells), k_cells), at) << order_name(order);
          EXPECT_EQ(order.tile_at(order.tile(at, k_cells), z, k_cells), at) << order_name(order);
        }
}

TEST(Decode, the_lists_of_every_storage_in_every_order_are_those_that_were_stored) {
  const assign::Lists lists = random_lists(k_cells, k_lights, 0.2, 1);
  const std::pair<const char*, std::map<std::string, assign::ParamValue>> storages[] = {
      {"packed", {}},
      {"packed", {{"index_bits", std::string("16")}}},
      {"packed", {{"header_size", 32.0}}},
      {"packed", {{"equal_lists", std::string("shared")}}},
      {"fixed", {}},
      {"fixed", {{"counts", std::string("none")}}},
      {"fixed", {{"cap", 40.0}}},
      {"bitfield", {}},
      {"linked", {}},
      {"runs", {}}};
  for (const auto& [storage, params] : storages)
    for (const CellOrder& order : all_orders())
      for (const view::LightRanges& lights : {view::LightRanges(40, 30), view::LightRanges(30, 20, 20)}) {
        const Described described = stored(storage, params, in_order(lists, k_cells, order), lights);
        const Decoded found = decoded(described, {k_cells, order, k_lights});
        EXPECT_EQ(found.lists, lists) << storage << " " << order_name(order);
        EXPECT_EQ(found.faults.count, 0u) << storage << " " << order_name(order);
      }
}

TEST(Decode, the_lists_of_engines_in_every_order_are_those_that_were_written) {
  const assign::Lists lists = random_lists(k_cells, k_lights, 0.2, 2);
  const std::pair<const char*, std::function<Described(const assign::Lists&)>> engines[] = {
      {"filament", filament},
      {"begins", begins},
      {"begin and end", begin_and_end},
      {"tutorial", [](const auto& given) { return tutorial(given, 100); }},
      {"playcanvas", [](const auto& given) { return from_one(given, 64); }},
      {"inline", in_json}};
  for (const auto& [engine, write] : engines)
    for (const CellOrder& order : all_orders()) {
      const Decoded found = decoded(write(in_order(lists, k_cells, order)), {k_cells, order, k_lights});
      EXPECT_EQ(found.lists, lists) << engine << " " << order_name(order);
      EXPECT_EQ(found.faults.count, 0u) << engine;
    }
}

TEST(Decode, bits_of_tiles_with_ranges_of_slices_in_every_order_are_those_that_were_written) {
  for (const bool per_tile : {false, true})
    for (const CellOrder& order : all_orders()) {
      const TileLists given = random_tiles(k_cells, k_lights, per_tile, 3);
      const Decoded found = decoded(tile_bits(given, k_cells, k_lights, order), {k_cells, order, k_lights});
      EXPECT_EQ(found.lists, given.lists) << per_tile << " " << order_name(order);
      EXPECT_EQ(found.faults.count, 0u);
    }
}

TEST(Decode, parts_of_a_set_are_united_and_may_begin_at_another_light) {
  const assign::Lists lists = random_lists(k_cells, k_lights, 0.2, 4);
  assign::Lists parts[2];
  for (assign::Lists& part : parts) part.begin.push_back(0);
  for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) {
    for (const std::uint32_t light : lists.of(cell))
      parts[light < 30 ? 0 : 1].lights.push_back(light < 30 ? light : light - 30);
    for (assign::Lists& part : parts) part.begin.push_back(static_cast<std::uint32_t>(part.lights.size()));
  }
  Described points = filament(parts[0]), spots = tutorial(parts[1], 60);
  spots.lists.first_light = 30;
  std::vector<Buffer> buffers = points.buffers;
  buffers.insert(buffers.end(), spots.buffers.begin(), spots.buffers.end());
  const ListPart both[] = {{points.lists, "/lists/0"}, {spots.lists, "/lists/1"}};
  EXPECT_EQ(decode(both, buffers, {k_cells, {}, k_lights}).lists, lists);
  EXPECT_EQ(bytes_of(both, buffers), buffers[0].bytes.size() + buffers[1].bytes.size() + buffers[2].bytes.size());
}

// One cell with lights 3 and 5 of 10, and what is wrong with it.
struct FaultRow {
  const char* name;
  std::function<void(Described&)> plant;
  std::uint64_t byte, value;
  const char* message;
};

void expect_faults(std::span<const FaultRow> rows, const Described& sound) {
  for (const FaultRow& row : rows) {
    Described described = sound;
    row.plant(described);
    const Faults faults = decoded(described, {Vec3i(1), {}, 10}).faults;
    ASSERT_EQ(faults.count, 1u) << row.name;
    EXPECT_EQ(faults.first[0].message, row.message);
    EXPECT_EQ(faults.first[0].byte, row.byte) << row.name;
    EXPECT_EQ(faults.first[0].value, row.value) << row.name;
    EXPECT_FALSE(faults.are_readable());
  }
}

TEST(Decode, a_value_that_cannot_be_right_is_named_with_its_byte) {
  const assign::Lists lists{{0, 2}, {3, 5}};
  const auto linked = [&] { return stored("linked", {}, lists, {10, 0}); };
  const FaultRow packed_rows[] = {
      {"index", [](Described& d) { put<std::uint8_t>(d.buffers[1].bytes, 1, 10); }, 1, 10,
       "index 10 is not below the 10 lights"},
      {"count", [](Described& d) { put<std::uint32_t>(d.buffers[0].bytes, 0, 0x0b); }, 0, 11,
       "count 11 is above the 10 lights of its part"},
      {"offset", [](Described& d) { put<std::uint32_t>(d.buffers[0].bytes, 0, 0x00010002); }, 0, 1,
       "offset 1 and count 2 end beyond the 2 entries of buffer 'records'"}};
  expect_faults(packed_rows, filament(lists));
  const FaultRow linked_rows[] = {
      {"circle", [](Described& d) { put<std::uint32_t>(d.buffers[0].bytes, 4, 1); }, 12, 0,
       "the list has more nodes than the 10 lights of its part: it goes in a circle, or has a light twice"},
      {"node", [](Described& d) { put<std::uint32_t>(d.buffers[0].bytes, 12, 7); }, 12, 7,
       "node 7 is not below the 2 nodes of buffer 'nodes'"}};
  for (const FaultRow& row : linked_rows) {
    Described described = linked();
    row.plant(described);
    const Faults faults = decoded(described, {Vec3i(1), {}, 10}).faults;
    ASSERT_GE(faults.count, 1u) << row.name;
    EXPECT_EQ(faults.first[0].message, row.message);
  }
}

TEST(Decode, an_end_that_cannot_be_right_is_named_with_its_byte) {
  const assign::Lists lists{{0, 2}, {3, 5}};
  const FaultRow rows[] = {{"before", [](Described& d) { put<std::uint32_t>(d.buffers[0].bytes, 0, 3); }, 4, 2,
                            "end 2 is before the offset 3"},
                           {"far", [](Described& d) { put<std::uint32_t>(d.buffers[0].bytes, 4, 11); }, 4, 11,
                            "end 11 is 11 behind the offset 0, more than the 10 lights of its part"},
                           {"beyond", [](Described& d) { put<std::uint32_t>(d.buffers[0].bytes, 4, 3); }, 0, 0,
                            "offset 0 and count 3 end beyond the 2 entries of buffer 'entries'"}};
  expect_faults(rows, begins(lists));
  Described odd = begin_and_end(lists);
  put<std::uint32_t>(odd.buffers[0].bytes, 4, 3);
  EXPECT_EQ(decoded(odd, {Vec3i(1), {}, 10}).faults.first[0].message,
            "end 3 is no multiple of 2 bytes behind the offset 0");
}

std::string refusal(const Described& described, const Shape& shape = {k_cells, {}, k_lights}) {
  try {
    decoded(described, shape);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(Decode, an_end_that_fits_no_row_is_refused_with_the_reason) {
  const assign::Lists lists{{0, 2}, {3, 5}};
  const std::pair<std::function<void(Described&)>, const char*> rows[] = {
      {[](Described& d) { d.buffers[0].bytes.resize(4); },
       "/lists/0/end: of the last cell would lie behind the end of buffer 'begins', in a row more than the 1 that its "
       "4 "
       "bytes hold"},
      {[](Described& d) {
         d.lists.counts = {{0, "u32", {}}};
       },
       "/lists/0/end: does not go with counts: either says how long a list is"},
      {[](Described& d) { d.lists.end->at = 0; },
       "/lists/0/end: is the field that `offset` is: all lists would be empty"},
      {[](Described& d) { d.lists.end->at = 5; },
       "/lists/0/end/at: is 5: its 4 bytes end beyond the next row; rows are 4 bytes apart"},
      {[](Described& d) { d.lists.end->at = ~std::uint64_t{0}; },
       "/lists/0/end/at: is 18446744073709551615: its 4 bytes end beyond the next row; rows are 4 bytes apart"},
      {[](Described& d) { d.lists.end.reset(); },
       "/lists/0: has neither counts nor end, and layout 'packed' needs one of them"}};
  for (const auto& [change, wanted] : rows) {
    Described described = begins(lists);
    change(described);
    EXPECT_EQ(refusal(described, {Vec3i(1), {}, 10}), wanted);
  }
}

TEST(Decode, lights_that_are_twice_in_a_list_are_counted_and_named_with_their_bytes) {
  const assign::Lists lists{{0, 4, 6}, {3, 5, 6, 7, 0, 1}};
  const Shape shape{Vec3i(2, 1, 1), {}, 10};
  Described records = filament(lists);
  for (const std::size_t byte : {1u, 3u}) put<std::uint8_t>(records.buffers[1].bytes, byte, 3);
  const Decoded found = decoded(records, shape);
  EXPECT_TRUE(found.faults.are_readable());
  EXPECT_EQ(found.lists, (assign::Lists{{0, 2, 4}, {3, 6, 0, 1}})) << "each light once";
  EXPECT_EQ(found.faults.twice, 2u) << "entries, not cells";
  ASSERT_EQ(found.faults.first_twice.size(), 2u);
  EXPECT_EQ(found.faults.first_twice[0].byte, 1u);
  EXPECT_EQ(found.faults.first_twice[1].byte, 3u);
  EXPECT_EQ(found.faults.first_twice[0].value, 3u);
  EXPECT_EQ(found.faults.first_twice[0].message, "light 3 is twice in its list, first at byte 0 of buffer 'records'");

  // Entries of two parts, of a row of bytes, and of a JSON file.
  const Described once = filament(lists);
  const Described again = tutorial(lists, 4);
  std::vector<Buffer> both = once.buffers;
  both.push_back(again.buffers[0]);
  const ListPart parts[] = {{once.lists, "/lists/0"}, {again.lists, "/lists/1"}};
  const Faults faults = decode(parts, both, shape).faults;
  EXPECT_EQ(faults.twice, 6u);
  EXPECT_EQ(faults.first_twice[4].buffer->name, "clusters");
  EXPECT_EQ(faults.first_twice[4].byte, 52u + 36u);
  Described in_file = in_json(lists);
  in_file.lists.cells->back() = {1, 1};
  EXPECT_EQ(decoded(in_file, shape).faults.first_twice.at(0).message, "light 1 is twice in its list");
}

TEST(Decode, lights_that_are_twice_do_not_hide_values_that_cannot_be_right) {
  assign::Lists lists{{0}, {}};
  for (std::uint32_t cell = 0; cell < 20; ++cell) {
    lists.lights.insert(lists.lights.end(), {4, 4});
    lists.begin.push_back(static_cast<std::uint32_t>(lists.lights.size()));
  }
  Described described = filament(lists);
  put<std::uint8_t>(described.buffers[1].bytes, 39, 12);  // in the last cell
  const Faults faults = decoded(described, {Vec3i(20, 1, 1), {}, 10}).faults;
  EXPECT_EQ(faults.twice, 19u);
  EXPECT_EQ(faults.first_twice.size(), Faults::k_most_kept);
  EXPECT_EQ(faults.count, 1u);
  ASSERT_EQ(faults.first.size(), 1u);
  EXPECT_EQ(faults.first[0].byte, 39u);
}

TEST(Decode, bits_of_lights_that_do_not_exist_and_ranges_beyond_them_are_faults) {
  Described bits = stored("bitfield", {}, {{0, 1}, {3}}, {10, 0});
  put<std::uint32_t>(bits.buffers[0].bytes, 0, 1u << 10);
  EXPECT_EQ(decoded(bits, {Vec3i(1), {}, 10}).faults.first[0].message, "index 10 is not below the 10 lights");
  TileLists tiles = random_tiles(Vec3i(2, 1, 2), 10, false, 1);
  tiles.ranges[0][1] = {3, 12};
  const Faults faults = decoded(tile_bits(tiles, Vec3i(2, 1, 2), 10, {}), {Vec3i(2, 1, 2), {}, 10}).faults;
  ASSERT_EQ(faults.count, 2u);
  EXPECT_EQ(faults.first[0].byte, 10u);
  EXPECT_EQ(faults.first[0].message, "the range of lights 3 to 11 is not below the 10 lights");
}

TEST(Decode, bits_of_other_things_before_and_after_those_of_lights_are_passed_over) {
  const assign::Lists lists = random_lists(k_cells, k_lights, 0.3, 7);
  for (const std::uint32_t first : {0u, 5u, 32u, 61u}) {
    Described bits;
    bits.buffers = {{"words", "words.bin", 0, {}}};
    bits.lists.layout = "bits";
    bits.lists.rows = result::DumpRows{"words", {}, 20};
    bits.lists.first_bit = first;
    for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) {
      std::vector<bool> row(160, true);  // all other things are there
      for (std::uint32_t light = 0; light < k_lights; ++light)
        row[first + light] = std::ranges::binary_search(lists.of(cell), light);
      for (std::uint32_t bit = 0; bit < 160; ++bit) {
        const std::size_t at = 20 * std::size_t{cell} + bit / 8;
        if (bit % 8 == 0) put<std::uint8_t>(bits.buffers[0].bytes, at, 0);
        if (row[bit]) bits.buffers[0].bytes[at] |= std::byte{1} << bit % 8;
      }
    }
    const Decoded found = decoded(bits, {k_cells, {}, k_lights});
    EXPECT_EQ(found.lists, lists) << first;
    EXPECT_EQ(found.faults.count, 0u);
    bits.lists.first_bit = 100;
    EXPECT_EQ(refusal(bits), "/lists/0/rows/stride: is 20; bits of 70 lights from bit 100 on take 24 bytes");
    bits.lists.first_bit = ~std::uint64_t{0};
    EXPECT_NE(refusal(bits), "");
  }
}

TEST(Decode, the_likeliest_other_reading_is_found) {
  const assign::Lists lists = random_lists(k_cells, k_lights, 0.2, 5);
  const Shape shape{k_cells, {}, k_lights};
  const std::pair<std::function<void(result::DumpLists&)>, const char*> rows[] = {
      {[](auto& given) { given.entries->type = "u32"; }, "with entries as u16 all "},
      {[](auto& given) { given.offset_is = "bytes"; }, "with the other unit of offsets (offset_is) all "},
      {[](auto& given) { std::swap(*given.offset, given.counts->front()); },  // of two counts
       "with offset and (first) count swapped all "},
      {[](auto& given) { given.entries->first_light = 2; },
       "with indices that count from 0 (entries.first_light) all "}};
  Described right = stored("packed", {{"index_bits", std::string("16")}}, lists, {40, 30});
  for (const auto& [change, wanted] : rows) {
    ListPart part{right.lists, "/lists/0"};
    change(part.lists);
    EXPECT_FALSE(decode({&part, 1}, right.buffers, shape).faults.are_readable()) << wanted;
    const auto likely = likely_reading({&part, 1}, right.buffers, shape);
    ASSERT_TRUE(likely) << wanted;
    EXPECT_EQ(likely->substr(0, std::string(wanted).size()), wanted);
  }
}

// Counts of 8 bits leave a small part of the lists, and nothing that is wrong in it.
TEST(Decode, an_end_that_was_taken_for_a_count_is_the_likeliest_reading_and_the_other_way_round) {
  const assign::Lists lists = random_lists(k_cells, k_lights, 0.2, 6);
  const Shape shape{k_cells, {}, k_lights};
  const auto reading_of = [&](const Described& given, const result::DumpLists& taken_for) {
    const ListPart part{taken_for, "/lists/0"};
    return likely_reading({&part, 1}, given.buffers, shape).value_or("none");
  };
  const Described ends = begin_and_end(lists);
  result::DumpLists as_counts = ends.lists;
  as_counts.counts = {*std::exchange(as_counts.end, std::nullopt)};
  EXPECT_EQ(reading_of(ends, as_counts).find("with the count as the end of the list (end) all "), 0u);
  result::DumpLists swapped = ends.lists;
  std::swap(*swapped.offset, *swapped.end);
  EXPECT_EQ(reading_of(ends, swapped).find("with offset and end swapped all "), 0u);
  result::DumpLists other = ends.lists;
  other.end->type = "f32";
  EXPECT_EQ(reading_of(ends, other).find("with ends as u32 all "), 0u);

  Described counted = begins(lists);
  counted.lists.counts = {{4, "u32", {}}};
  counted.lists.end.reset();
  counted.lists.rows->stride = 8;
  counted.buffers[0].bytes.clear();
  for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) {
    put(counted.buffers[0].bytes, 8 * std::size_t{cell}, lists.begin[cell]);
    put(counted.buffers[0].bytes, 8 * std::size_t{cell} + 4, static_cast<std::uint32_t>(lists.of(cell).size()));
  }
  result::DumpLists as_end = counted.lists;
  as_end.end = std::exchange(as_end.counts, std::nullopt)->front();
  EXPECT_EQ(reading_of(counted, as_end).find("with the end as a count of entries (counts) all "), 0u);
}

TEST(Decode, a_reading_that_leaves_a_small_part_of_the_indices_is_no_likely_one) {
  Described wide;
  wide.buffers = {{"rows", "rows.bin", 0, {}}, {"indices", "indices.bin", 0, {}}};
  wide.lists.layout = "packed";
  wide.lists.rows = result::DumpRows{"rows", {}, 8};
  wide.lists.offset = result::DumpField{0, "u32", {}};
  wide.lists.counts = std::vector<result::DumpField>{{4, "u32", {}}};
  wide.lists.entries = result::DumpEntries{"indices", {}, "u32", {}, {}, {}};
  constexpr std::uint32_t k_lists = 4, k_long = 260, k_wide_lights = 300;
  for (std::uint32_t cell = 0; cell < k_lists; ++cell) {
    put<std::uint32_t>(wide.buffers[0].bytes, 8 * cell, k_long * cell);
    put<std::uint32_t>(wide.buffers[0].bytes, 8 * cell + 4, k_long);
    for (std::uint32_t i = 0; i < k_long; ++i) put<std::uint32_t>(wide.buffers[1].bytes, 4 * (k_long * cell + i), i);
  }
  const Shape shape{{2, 2, 1}, {}, k_wide_lights};
  ListPart part{wide.lists, "/lists/0"};
  EXPECT_TRUE(decode({&part, 1}, wide.buffers, shape).faults.are_readable());
  put<std::uint32_t>(wide.buffers[1].bytes, 4 * (k_long - 1), 7777);  // one index is wrong: 4 of 260 would be left
  EXPECT_FALSE(likely_reading({&part, 1}, wide.buffers, shape));
  // Indices that count from 1 are tried before all else.
  for (std::uint32_t i = 0; i < k_lists * k_long; ++i)
    put<std::uint32_t>(wide.buffers[1].bytes, 4 * i, k_wide_lights - i % k_long);
  const auto likely = likely_reading({&part, 1}, wide.buffers, shape);
  ASSERT_TRUE(likely);
  EXPECT_EQ(*likely, "with indices that count from 1 (entries.first_light) all 1040 indices are below 300");
}

std::string refusal_of(const Described& described, std::uint32_t lights = 10) {
  try {
    decoded(described, {Vec3i(1), {}, lights});
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(Decode, descriptions_that_do_not_fit_are_refused_without_overflow) {
  const Described right = tutorial({{0, 2}, {3, 5}}, 4);
  EXPECT_EQ(refusal_of(right), "");
  const std::uint64_t huge = ~std::uint64_t{0};
  const std::pair<std::function<void(result::DumpLists&)>, const char*> rows[] = {
      {[&](auto& d) { d.rows->at = huge; }, "/lists/0/rows: 1 row, 52 bytes apart"},
      {[&](auto& d) { d.rows->stride = 36; },
       "/lists/0/entries/at: is 36: 4 entries there end beyond the stride of 36"},
      {[&](auto& d) { d.per_cell = huge; }, "/lists/0/per_cell: is 18446744073709551615, which no buffer holds"},
      {[&](auto& d) { d.per_cell = huge / 8; }, "/lists/0/entries/at"},
      {[&](auto& d) { d.entries->at = huge; }, "/lists/0/entries/at"},
      {[&](auto& d) { d.entries->stride = 0; }, "/lists/0/entries/stride: is 0"},
      {[&](auto& d) { d.counts->front().at = huge; }, "/lists/0/counts/0/at: is 18446744073709551615"},
      {[&](auto& d) { d.counts->front().at = 49; }, "/lists/0/counts/0/at: is 49: its 4 bytes end beyond the stride"},
      {[&](auto& d) {
         d.counts->front().bits = result::Counts2{30, 4};
       },
       "/lists/0/counts/0/bits: is [30, 4]"},
      {[&](auto& d) {
         d.counts->front().bits = result::Counts2{1, huge};
       },
       "/lists/0/counts/0/bits"},
      {[&](auto& d) { d.rows->buffer = "cluster"; },
       "/lists/0/rows/buffer: found 'cluster' (did you mean 'clusters'?)"},
      {[&](auto& d) { d.counts.reset(); }, "/lists/0: layout 'fixed' needs counts or entries.end"},
      {[&](auto& d) { d.first_light = 11; }, "/lists/0/first_light: is 11; the dump has 10 lights"},
      {[&](auto& d) { d.lights = 11; }, "/lists/0/lights: is 11 from 0 on; the dump has 10 lights"},
      {[&](auto& d) { d.layout = "packed"; }, "/lists/0/offset: is missing: layout 'packed' needs it"},
      {[&](auto& d) { d.layout = "linked"; }, "/lists/0/nodes: is missing"},
      {[&](auto& d) { d.layout = "bits_and_bins"; }, "/lists/0/ranges: is missing"},
      {[&](auto& d) { d.layout = "inline"; }, "/lists/0/cells: is missing"}};
  for (const auto& [change, wanted] : rows) {
    Described changed = right;
    change(changed.lists);
    EXPECT_EQ(refusal_of(changed).substr(0, std::string(wanted).size()), wanted);
  }
}

TEST(Decode, lists_that_take_more_memory_than_allowed_are_refused) {
  const assign::Lists lists = random_lists(Vec3i(16, 16, 8), 200, 0.9, 6);
  const Described bits = stored("bitfield", {}, lists, {200, 0});
  const MemoryLimitScope limit(std::uint64_t{1} << 20);
  EXPECT_THROW(decoded(bits, {Vec3i(16, 16, 8), {}, 200}), Error);
}

TEST(Decode, numbers_of_all_types_are_read) {
  std::vector<std::byte> bytes;
  put<std::uint64_t>(bytes, 1, 0x0123456789abcdefu);
  put<float>(bytes, 9, 2.5f);
  put<double>(bytes, 13, -3.25);
  put<std::uint16_t>(bytes, 21, 0x3e00);  // 1.5 in binary16
  EXPECT_EQ(whole_at(bytes.data() + 1, NumberType::u64), 0x0123456789abcdefu);
  EXPECT_EQ(whole_at(bytes.data() + 1, NumberType::u32), 0x89abcdefu);
  EXPECT_EQ(whole_at(bytes.data() + 1, NumberType::u16), 0xcdefu);
  EXPECT_EQ(whole_at(bytes.data() + 1, NumberType::u8), 0xefu);
  EXPECT_EQ(real_at(bytes.data() + 9, NumberType::f32), 2.5);
  EXPECT_EQ(whole_at(bytes.data() + 9, NumberType::f32), k_no_whole);
  EXPECT_EQ(real_at(bytes.data() + 13, NumberType::f64), -3.25);
  EXPECT_EQ(real_at(bytes.data() + 21, NumberType::f16), 1.5);
  put<float>(bytes, 9, 7.0f);
  EXPECT_EQ(whole_at(bytes.data() + 9, NumberType::f32), 7u);
}

}  // namespace
}  // namespace clusterbench::layout
